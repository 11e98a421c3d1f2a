/** Files of one's own: dropped or chosen, read here, sent as text. */
import { useState } from "preact/hooks";
import { DropArea, PickFiles } from "../drop_area";
import { textsOf } from "../files";
import { SPRINGS } from "../history";
import { idOf } from "../own/term_file";
import { resume } from "../session";
import { missing, type NamedFile, ROLES, type Role, withFiles } from "./roles";
import type { StartProps } from "./screen";

export function Files({ store, catalogue }: StartProps) {
  const [files, setFiles] = useState<NamedFile[]>([]);
  const [tooLarge, setTooLarge] = useState("");
  const take = async (chosen: File[]) => {
    const large = chosen.filter((file) => file.size > catalogue.limits.bytes);
    setTooLarge(large.length > 0 ? `${large[0]?.name} is larger than ${megabytes(catalogue.limits.bytes)}.` : "");
    const texts = await textsOf(chosen.filter((file) => !large.includes(file)));
    setFiles((old) => withFiles(old, texts));
  };
  const lacks = files.length === 0 ? "" : missing(files);
  return (
    <DropArea take={(chosen) => void take(chosen)}>
      <h2>Your own files</h2>
      <p>
        Drop hexapod.toml and measurements.csv here, and holdout.csv and a saved session.json if you have them. All files stay on this
        computer.
      </p>
      <PickFiles name="files" title="Choose files" accept=".toml,.csv,.txt,.dat,.json" take={(chosen) => void take(chosen)} />
      {files.length > 0 && <Chosen files={files} setFiles={setFiles} />}
      {(tooLarge || lacks) && <p class="hint">{tooLarge || lacks}</p>}
      <button
        type="button"
        class="main"
        data-testid="open-files"
        disabled={files.length === 0 || lacks !== ""}
        onClick={() => open(store, files)}
      >
        Open files
      </button>
    </DropArea>
  );
}

function Chosen({ files, setFiles }: { files: NamedFile[]; setFiles: (files: NamedFile[]) => void }) {
  const change = (name: string, role: Role) => setFiles(files.map((file) => (file.name === name ? { ...file, role } : file)));
  return (
    <ul class="files">
      {files.map(({ name, role }) => (
        <li key={name} class="row">
          <label class="row">
            <span>{name}</span>
            <select value={role} data-testid={`role-${name}`} onChange={(event) => change(name, event.currentTarget.value as Role)}>
              {ROLES.map((choice) => (
                <option key={choice.role} value={choice.role}>
                  {choice.title}
                </option>
              ))}
            </select>
          </label>
          <button
            type="button"
            class="quiet"
            aria-label={`Remove ${name}`}
            onClick={() => setFiles(files.filter((file) => file.name !== name))}
          >
            Remove
          </button>
        </li>
      ))}
    </ul>
  );
}

function open(store: StartProps["store"], files: NamedFile[]): void {
  const one = (role: Role) => files.filter((file) => file.role === role).map(({ name, text }) => ({ name, text }));
  const [hexapod] = one("hexapod");
  const [data] = one("data");
  const own = one("term").map(({ text }) => text);
  if (hexapod === undefined || data === undefined) return;
  const request = { from: "files", hexapod, data, holdout: one("holdout")[0] ?? null } as const;
  const [session] = one("session");
  const opened = own.length === 0 ? store.open(request) : store.open(request, { ...SPRINGS, terms: own.map(idOf), own });
  if (session !== undefined) void opened.then(() => resume(store, session));
}

function megabytes(bytes: number): string {
  return `${Math.round(bytes / 1e5) / 10} MB`;
}

/** Files of one's own: dropped or chosen, read here, sent as text. */
import { useState } from "preact/hooks";
import { idOf } from "../own/term_file";
import { missing, type NamedFile, ROLES, type Role, withFiles } from "./roles";
import type { StartProps } from "./screen";

export function Files({ store, catalogue }: StartProps) {
  const [files, setFiles] = useState<NamedFile[]>([]);
  const [over, setOver] = useState(false);
  const [tooLarge, setTooLarge] = useState("");
  const take = async (list: FileList | null | undefined) => {
    const chosen = [...(list ?? [])];
    const large = chosen.filter((file) => file.size > catalogue.limits.bytes);
    setTooLarge(large.length > 0 ? `${large[0]?.name} is larger than ${megabytes(catalogue.limits.bytes)}.` : "");
    const fitting = chosen.filter((file) => !large.includes(file));
    const texts = await Promise.all(fitting.map(async (file) => ({ name: file.name, text: await file.text() })));
    setFiles((old) => withFiles(old, texts));
  };
  const lacks = files.length === 0 ? "" : missing(files);
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: dropping is a shortcut, the button does the same.
    <section
      class={over ? "card drop over" : "card drop"}
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => {
        event.preventDefault();
        setOver(false);
        void take(event.dataTransfer?.files);
      }}
    >
      <h2>Your own files</h2>
      <p>
        Drop hexapod.toml, measurements.csv and, if there is one, holdout.csv here, or{" "}
        <label class="button">
          choose them
          <input
            type="file"
            multiple
            class="unseen"
            data-testid="files"
            accept=".toml,.csv,.txt,.dat"
            onChange={(event) => void take(event.currentTarget.files)}
          />
        </label>
        . They stay on this computer.
      </p>
      {files.length > 0 && <Chosen files={files} setFiles={setFiles} />}
      {(tooLarge || lacks) && <p class="hint">{tooLarge || lacks}</p>}
      <button
        type="button"
        class="main"
        data-testid="open-files"
        disabled={files.length === 0 || lacks !== ""}
        onClick={() => open(store, files)}
      >
        Open them
      </button>
    </section>
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
  void (own.length === 0 ? store.open(request) : store.open(request, { terms: own.map(idOf), own }));
}

function megabytes(bytes: number): string {
  return `${Math.round(bytes / 1e5) / 10} MB`;
}

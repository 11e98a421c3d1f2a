/** A part of the page on which files can be dropped. */
import { useState } from "preact/hooks";

interface Props {
  take: (files: File[]) => void;
  children: preact.ComponentChildren;
}

export function DropArea({ take, children }: Props) {
  const [over, setOver] = useState(false);
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: dropping is a shortcut, a button does the same.
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
        take([...(event.dataTransfer?.files ?? [])]);
      }}
    >
      {children}
    </section>
  );
}

interface PickProps {
  name: string;
  title: string;
  accept: string;
  take: (files: File[]) => void;
}

/** A button that chooses files. */
export function PickFiles({ name, title, accept, take }: PickProps) {
  return (
    <label class="button">
      {title}
      <input
        type="file"
        multiple
        class="unseen"
        data-testid={name}
        accept={accept}
        onChange={(event) => {
          take([...(event.currentTarget.files ?? [])]);
          // The same file can be chosen again.
          event.currentTarget.value = "";
        }}
      />
    </label>
  );
}

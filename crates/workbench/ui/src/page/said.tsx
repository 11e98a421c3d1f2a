/** What the program says: a page of sections, the same in every medium. */

import { unitName } from "../format";
import { Scroll } from "../scroll";
import type { Block, Cell, Definition, Section, Table } from "../wire";
import { isTyped } from "./here";
import { Inline } from "./inline";

/** `name`: what tests call the sections where some are said twice. */
export function Said({ sections, name = "section" }: { sections: Section[]; name?: string }) {
  return (
    <div class="said" data-testid={name === "section" ? "said" : undefined}>
      {sections.map((section) => (
        <section key={section.id} data-testid={`${name}-${section.id}`}>
          {section.title !== "" && <h3>{section.title}</h3>}
          {section.remark !== "" && (
            <p class="hint">
              <Inline text={section.remark} />
            </p>
          )}
          {section.blocks.map((block, index) => (
            <Shown key={index} block={block} />
          ))}
        </section>
      ))}
    </div>
  );
}

function Shown({ block }: { block: Block }) {
  switch (block.kind) {
    case "verdict":
      return (
        <p class={`verdict ${block.mood}`} data-testid="verdict" data-word={block.word.toLowerCase()}>
          <strong>{block.word}</strong> <Inline text={block.sentences.join(" ")} />
        </p>
      );
    case "paragraph":
      return (
        <p>
          <Inline text={block.text} />
        </p>
      );
    case "list":
      return (
        <ul>
          {block.items.map((item) => (
            <li key={item}>
              <Inline text={item} />
            </li>
          ))}
        </ul>
      );
    case "entries":
      return <Entries number={block.number} entries={block.entries} />;
    case "code":
      return isTyped(block.text) ? null : <pre>{block.text}</pre>;
    case "table":
      return block.rows.length > LONG ? <Folded table={block} /> : <Rows table={block} />;
    case "figure":
      return null;
  }
}

function Entries({ number, entries }: { number: number | null; entries: Definition[] }) {
  return (
    <dl data-number={number ?? undefined}>
      {entries.map(({ label, text }) => [
        <dt key={`${label}-name`}>
          <Inline text={label} />
        </dt>,
        <dd key={label}>
          <Inline text={text} />
        </dd>,
      ])}
    </dl>
  );
}

/** A table of more rows is folded: few read all of them. */
const LONG = 14;

function Folded({ table }: { table: Table }) {
  const columns = table.columns.map(({ title }) => title).filter((title) => title !== "");
  return (
    <details>
      <summary>
        {table.rows.length} rows: <Inline text={columns.join(", ")} />
      </summary>
      <Rows table={table} />
    </details>
  );
}

function Rows({ table }: { table: Table }) {
  const words = (index: number) => (table.columns[index]?.words ? "words" : undefined);
  return (
    <Scroll label={table.title || "Table"} stacks>
      <table>
        {table.title !== "" && <caption>{unitName(table.title)}</caption>}
        {table.columns.some(({ title }) => title !== "") && (
          <thead>
            <tr>
              {table.columns.map(({ title }, index) =>
                title === "" ? (
                  <td key={index} />
                ) : (
                  <th key={index} scope="col" class={words(index)}>
                    <Inline text={title} />
                  </th>
                ),
              )}
            </tr>
          </thead>
        )}
        <tbody>
          {table.rows.map((row, index) => (
            <tr key={index}>
              {row.map((cell, column) => (
                <Content key={column} cell={cell} title={table.columns[column]?.title ?? ""} words={words(column)} />
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

function Content({ cell, title, words }: { cell: Cell; title: string; words: string | undefined }) {
  if (typeof cell === "string") {
    return (
      <td class={words} data-title={title === "" ? undefined : unitName(title)}>
        <Inline text={cell} />
      </td>
    );
  }
  return (
    <td class="wide">
      <span class="track">
        <span class={`bar ${cell.mood ?? ""}`} style={{ width: `${100 * cell.bar}%` }} />
        {cell.mark !== null && <span class="noise-line" style={{ left: `${100 * cell.mark}%` }} />}
      </span>
    </td>
  );
}

/** What the program says of its commands, in words of this page: where to click instead. */

/** A way to read files, as a button names it; a full stop behind it ends the sentence. */
const WAYS = /add ((?:--read-as \S+?\s?)+)(?=[.;,]?(?:\s|$))/g;
const WAY = /--read-as (\S+)/g;

/** Marks of code may be gone: in text taken from a report, they are. */
const WORDS: [RegExp, string][] = [
  [/or read differently with --read-as,/g, 'or read differently with "Read as ...",'],
  [/remove --read-as \S+?(?=[.;,]?(?:\s|$))/g, 'click "Read as written"'],
  [/leave a line out with `?--exclude LINE`?/g, "leave a line out in the view Readings"],
  [/`?hexbench diagnose`? leaves a wrong reading out/g, "the diagnosis leaves a wrong reading out"],
  [/see the findings of `?hexbench diagnose`?/g, "see the diagnosis"],
  [/see `?hexbench diagnose`?/g, "see the diagnosis"],
  [/\(`?hexbench power`?: a test of (.*?), which sees smaller ones\)/g, "(a test of $1 sees smaller ones)"],
  [
    /run `?hexbench discover`? with the same files and `?-o term\.toml`?, then the same `?hexbench diagnose`? with `?--term term\.toml`?, which compares/g,
    'click "Search for a law", add it as a term, then "Diagnose again", which compares',
  ],
  [
    /`?hexbench discover`? with the same files searches for the law behind it, writes it as a term \(-o term\.toml\) that `?hexbench diagnose --term term\.toml`? compares/g,
    '"Search for a law" searches for the law behind it, and adds it as a term that "Diagnose again" compares',
  ],
  [
    /Write the law with -o term\.toml; these commands then compare it like any effect, and save it for predictions and corrected commands:/g,
    'Add the law as a term; "Diagnose again" then compares it like any effect, and the model that you download contains it.',
  ],
  [/`?hexbench terms`?( TERM)? (lists|says)/g, "the list of terms $2"],
  [/ of the session: its SHA-256 is [0-9a-f]+, not [0-9a-f]+/g, " of the session: it holds other data than when the session was saved"],
  [
    /Use the unchanged file; for another file, start a new session in `?hexbench workbench`?\./g,
    'To go on with the session, click "Open other data" and choose the files it was saved with together with session.json; what you see here is unchanged.',
  ],
  [/, in the file or with --columns:/g, " in the file:"],
  [/, or map them to columns of the table with --columns/g, ""],
  [/, or allow more \(`?--max-rows`?\)/g, ""],
];

export function here(text: string): string {
  const read = text.replace(WAYS, (all: string) => `click "Read as ${[...all.matchAll(WAY)].map(([, way]) => way).join(", then ")}"`);
  return WORDS.reduce((said, [command, words]) => said.replace(command, words), read);
}

/** Lines to be typed, which a page has no use for. */
export function isTyped(text: string): boolean {
  return text.startsWith("hexbench ");
}

/** A picture that the program has drawn, in the colors of this page: wide or narrow, and in words. */
import { useLayoutEffect, useRef } from "preact/hooks";
import type { StoryChart } from "../wire";
import { Inline } from "./inline";

export function Picture({ picture }: { picture: StoryChart }) {
  return (
    <figure class="picture" data-testid="picture">
      <Drawn svg={picture.wide} width="wide" />
      <Drawn svg={picture.narrow} width="narrow" />
      <figcaption class="hint">{picture.caption}</figcaption>
      <details>
        <summary>The picture in words</summary>
        <ul data-testid="picture-words">
          {picture.words.map((words) => (
            <li key={words}>
              <Inline text={words} />
            </li>
          ))}
        </ul>
      </details>
    </figure>
  );
}

/** The drawing as an element of the page: it follows its colors, and its label is read out. */
function Drawn({ svg, width }: { svg: string; width: string }) {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const drawn = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
    if (drawn.localName === "svg") box.current?.replaceChildren(document.importNode(drawn, true));
  }, [svg]);
  return <div ref={box} class={width} data-testid={`picture-${width}`} />;
}

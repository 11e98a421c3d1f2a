/** Requests to the server, and what can go wrong with them. */
import type {
  Ask,
  Catalogue,
  CheckedFiles,
  Diagnosed,
  Discovered,
  Export,
  Exported,
  FileText,
  Followed,
  Guess,
  KeepSession,
  Open,
  Opened,
  Pictured,
  PlannedReadings,
  PlanReadings,
  ReadingChoice,
  Refused,
  Resumed,
  Revealed,
  Selection,
  Tried,
  Try,
  View,
  What,
} from "./wire";

/** The server's answer was no. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly next: string,
  ) {
    super(message);
  }
}

/** No answer came at all. */
export class ServerGone extends Error {
  constructor() {
    super("The workbench is not responding.");
  }
}

const LONGEST_WAIT_S = 10;

export class Api {
  constructor(private readonly token: string) {}

  catalogue(): Promise<Catalogue> {
    return this.ask("GET", "/api/catalogue");
  }

  open(open: Open, signal?: AbortSignal): Promise<Opened> {
    return this.ask("POST", "/api/benches", open, signal);
  }

  view(bench: string, selection: Selection, signal?: AbortSignal): Promise<View> {
    return this.ask("POST", `/api/benches/${bench}/view`, selection, signal);
  }

  tryEach(bench: string, each: string[], selection: Selection, signal?: AbortSignal): Promise<Tried> {
    return this.ask("POST", `/api/benches/${bench}/trials`, { each, ...selection } satisfies Try, signal);
  }

  followed(bench: string, selection: Selection, signal?: AbortSignal): Promise<Followed> {
    return this.ask("POST", `/api/benches/${bench}/followed`, selection, signal);
  }

  picture(bench: string, selection: Selection, signal?: AbortSignal): Promise<Pictured> {
    return this.ask("POST", `/api/benches/${bench}/picture`, selection, signal);
  }

  check(bench: string, asked: Ask, signal?: AbortSignal): Promise<CheckedFiles> {
    return this.ask("POST", `/api/benches/${bench}/check`, asked, signal);
  }

  diagnose(bench: string, asked: Ask, signal?: AbortSignal): Promise<Diagnosed> {
    return this.ask("POST", `/api/benches/${bench}/diagnosis`, asked, signal);
  }

  plan(bench: string, asked: PlanReadings, signal?: AbortSignal): Promise<PlannedReadings> {
    return this.ask("POST", `/api/benches/${bench}/plan`, asked, signal);
  }

  discover(bench: string, asked: Ask, signal?: AbortSignal): Promise<Discovered> {
    return this.ask("POST", `/api/benches/${bench}/discovery`, asked, signal);
  }

  export(bench: string, what: What, plan: ReadingChoice, selection: Selection, signal?: AbortSignal): Promise<Exported> {
    return this.ask("POST", `/api/benches/${bench}/export`, { what, plan, ...selection } satisfies Export, signal);
  }

  keep(bench: string, session: KeepSession, signal?: AbortSignal): Promise<Exported> {
    return this.ask("POST", `/api/benches/${bench}/session`, session, signal);
  }

  resume(bench: string, file: FileText, signal?: AbortSignal): Promise<Resumed> {
    return this.ask("POST", `/api/benches/${bench}/resume`, file, signal);
  }

  reveal(bench: string, guess: string[], signal?: AbortSignal): Promise<Revealed> {
    return this.ask("POST", `/api/benches/${bench}/reveal`, { guess } satisfies Guess, signal);
  }

  /** One request; a busy server is asked once more after the time it names. */
  private async ask<T>(method: string, path: string, body?: unknown, signal?: AbortSignal): Promise<T> {
    let answer = await this.send(method, path, body, signal);
    if (answer.status === 503) {
      await pause(waitOf(answer), signal);
      answer = await this.send(method, path, body, signal);
    }
    if (!answer.ok) throw await refusal(answer);
    return (await answer.json()) as T;
  }

  private async send(method: string, path: string, body: unknown, signal?: AbortSignal): Promise<Response> {
    const headers: Record<string, string> = { authorization: `Bearer ${this.token}` };
    if (body !== undefined) headers["content-type"] = "application/json";
    try {
      return await fetch(path, {
        method,
        headers,
        body: body === undefined ? null : JSON.stringify(body),
        signal: signal ?? null,
        cache: "no-store",
      });
    } catch (error) {
      if (aborted(error)) throw error;
      throw new ServerGone();
    }
  }
}

/** True for a request this page has called off itself. */
export function aborted(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

async function refusal(answer: Response): Promise<Refusal> {
  const body: Partial<Refused> = await answer.json().catch(() => ({}));
  return new Refusal(answer.status, body.error ?? `The server refused the request (status ${answer.status}).`, body.next ?? "");
}

function waitOf(answer: Response): number {
  const seconds = Number(answer.headers.get("retry-after") ?? "1");
  return 1000 * Math.min(Number.isFinite(seconds) ? seconds : 1, LONGEST_WAIT_S);
}

function pause(ms: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, ms);
    signal?.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(new DOMException("", "AbortError"));
    });
  });
}

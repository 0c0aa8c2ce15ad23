/** The server's side of the drawing: its messages, and edits that are sent one after the other. */

export type Axis = "rows" | "cols";
export type Square = [number, number];

export interface Stall { name: string; number: string | number | null; use: string; kind: string; corners: [number, number][] }
export interface Level { name: string; rows: string[]; stalls: Stall[]; ways: [number, number, number, number][] }
export interface Finding { severity: string; rule: string; message: string; place: string; at: [number, number] | null }
export interface Sketch { state: "drawn" | "planned" | "open" | "refused"; levels: Level[]; rows_m: number[]; cols_m: number[]; findings: Finding[] }
export interface Run { first: Square; last: Square; edge: string; kind: string; size: string }
export interface FileState {
  number: number; name: string; folder: string; is_new: boolean; is_saved: boolean; can_undo: boolean; can_redo: boolean; kept: boolean;
  view: string; warning?: string;
}
export interface State extends FileState {
  levels: number; place: { square: Square; way: string; aside: string | null } | null; given_sides: [boolean, boolean]; runs: Run[];
  values: Record<string, string | number | boolean>; given: string[]; drawn_look: boolean; has_lanes: boolean; is_working: boolean; sketch: Sketch;
  seconds: number;
}
export interface Control {
  name: string; group: string; kind: "choice" | "switch" | "whole" | "number" | "colour"; text: string;
  choices?: string[]; words?: string[]; least?: number; most?: number;
}
export interface Progress { step: string; done: number; total: number; error: string; seconds: number; is_working: boolean }

/** An answer that says why something was refused; `isStale` if the drawing or its file is not as this page knows it. */
export class Refusal extends Error {
  constructor(message: string, readonly isStale: boolean) {
    super(message);
  }
}

export async function ask<T>(name: string): Promise<T> {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error("The program that draws has ended; start it again to go on.");
  return (await answer.json()) as T;
}

export async function tell<T>(name: string, message: object = {}): Promise<T> {
  const answer = await fetch(name, { method: "POST", body: JSON.stringify(message) });
  const told = (await answer.json()) as T & { error?: string };
  if (!answer.ok) throw new Refusal(told.error ?? answer.statusText, answer.status === 409);
  return told;
}

/** Messages that change the drawing, in their order; each tells the version that it is for. */
export class Desk<Kind extends FileState> {
  /** As of the last answer; from the first one on. */
  state!: Kind;
  private last: Promise<unknown> = Promise.resolve();
  private waiting = 0;

  constructor(private readonly shown: (state: Kind) => void, private readonly refused: (error: Error) => void) {}

  get isBusy(): boolean {
    return this.waiting > 0;
  }

  edit(edit: object, stroke = ""): Promise<boolean> {
    return this.send("edit", () => ({ number: this.state.number, edit, stroke }));
  }

  send(name: string, message: () => object = () => ({})): Promise<boolean> {
    this.waiting++;
    const sent = this.last.then(async () => {
      try {
        this.take(await tell<Kind>(name, message()));
        return true;
      } catch (error) {
        await this.refresh();
        this.refused(error as Error);
        return false;
      } finally {
        this.waiting--;
      }
    });
    this.last = sent;
    return sent;
  }

  async refresh(): Promise<void> {
    try {
      this.take(await ask<Kind>("state"));
    } catch (error) {
      this.refused(error as Error);
    }
  }

  private take(state: Kind): void {
    this.state = state;
    this.shown(state);
  }
}

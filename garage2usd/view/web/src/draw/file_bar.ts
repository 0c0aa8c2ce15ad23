/** What the pages of drawings share: the file with undo, save and open, the notice, the 3D view, and the guard of unsaved work. */

import { ask, type Desk, type FileState, Refusal, tell } from "./desk";
import DIALOGS from "./dialogs.html?raw";
import "./style.css";

const LOOK_EVERY_MS = 4000;

export const byId = <Kind extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as Kind;
export const input = (id: string) => byId<HTMLInputElement>(id);
export const select = (id: string) => byId<HTMLSelectElement>(id);
export const plural = (count: number, word: string) => `${count} ${word}${count === 1 ? "" : "s"}`;

export function made<Name extends keyof HTMLElementTagNameMap>(
  name: Name, attributes: Record<string, string | number>, ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) if (value !== "") element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

export class FileBar<State extends FileState> {
  private isLeaving = false;

  constructor(private readonly desk: Desk<State>, private readonly isPainting: () => boolean) {
    document.body.insertAdjacentHTML("beforeend", DIALOGS);
    const on = (id: string, act: () => void) => byId(id).addEventListener("click", act);
    on("undo", () => void desk.send("undo"));
    on("redo", () => void desk.send("redo"));
    on("save", () => void this.save());
    on("save-as", () => this.openSave());
    on("open", () => void this.openFiles());
    on("build", () => void this.build());
    on("view-close", () => byId<HTMLDialogElement>("view-dialog").close());
    on("new-survey", () => void this.open({ name: "lot.toml", survey: true }));
    byId("view-dialog").addEventListener("close", () => byId("view-frame").removeAttribute("src"));
    byId("save-dialog").addEventListener("close", () => {
      if (byId<HTMLDialogElement>("save-dialog").returnValue === "save") void this.save({ name: input("file-name").value });
    });
    input("open-file").addEventListener("change", () => void this.openText(input("open-file").files?.[0]));
    document.addEventListener("keydown", (event) => this.shortcut(event));
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.openText([...(event.dataTransfer?.files ?? [])].find(({ name }) => name.endsWith(".toml")));
    });
    window.addEventListener("beforeunload", (event) => {
      if (!this.isLeaving && (!desk.state?.is_saved || desk.isBusy)) event.preventDefault();
    });
    window.addEventListener("focus", () => void this.look());
    window.setInterval(() => void this.look(), LOOK_EVERY_MS);
  }

  /** Take the first state, and offer the work that an earlier page left. */
  async begin(): Promise<void> {
    await this.desk.refresh();
    if (this.desk.state.kept)
      this.ask("A page ended here with work that was not saved.", [
        ["Take it", () => void this.desk.send("restore", () => ({ take: true }))],
        ["Leave it", () => void this.desk.send("restore", () => ({ take: false }))],
      ]);
  }

  show(state: State): void {
    byId("name").textContent = state.name;
    byId("saved").textContent = state.is_saved ? "saved" : state.is_new ? "not saved yet" : "changed";
    document.title = `${state.is_saved ? "" : "\u2022 "}${state.name}`;
    byId<HTMLButtonElement>("undo").disabled = !state.can_undo;
    byId<HTMLButtonElement>("redo").disabled = !state.can_redo;
    for (const folder of document.querySelectorAll(".folder")) folder.textContent = state.folder;
    if (state.warning) this.ask(state.warning, []);
  }

  refuse(error: Error): void {
    this.ask(error.message, []);
  }

  ask(text: string, answers: [string, () => void][]): void {
    byId("notice-text").textContent = text;
    const buttons = [...answers, ...(answers.length ? [] : [["Close", () => undefined] as [string, () => void]])].map(([name, act]) => {
      const button = made("button", {}, name);
      button.addEventListener("click", () => {
        this.hideNotice();
        act();
      });
      return button;
    });
    byId("notice-buttons").replaceChildren(...buttons);
    byId("notice").hidden = false;
  }

  private hideNotice(): void {
    byId("notice").hidden = true;
  }

  private shortcut(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey)) return;
    const key = event.key.toLowerCase();
    const isTyping = event.target instanceof HTMLInputElement && event.target.type !== "radio" && event.target.type !== "checkbox";
    if (key === "s") void this.save();
    else if (key === "o") void this.openFiles();
    else if (isTyping) return;
    else if (key === "z" && !event.shiftKey) void this.desk.send("undo");
    else if (key === "y" || key === "z") void this.desk.send("redo");
    else return;
    event.preventDefault();
  }

  private async rest(): Promise<void> {
    while (this.desk.isBusy) await new Promise((done) => setTimeout(done, 20));
  }

  private openSave(): void {
    input("file-name").value = this.desk.state.name;
    const dialog = byId<HTMLDialogElement>("save-dialog");
    dialog.returnValue = "";
    dialog.showModal();
    input("file-name").select();
  }

  private async save(message: { name?: string; over?: boolean } = {}): Promise<boolean> {
    await this.rest();
    let isSaved = true;
    try {
      await tell<State>("save", message);
      this.hideNotice();
    } catch (error) {
      const isStale = error instanceof Refusal && error.isStale;
      this.ask((error as Error).message, isStale ? [["Write over it", () => void this.save({ ...message, over: true })], ["Leave it", () => undefined]] : []);
      isSaved = false;
    }
    await this.desk.refresh();
    return isSaved;
  }

  private async openFiles(): Promise<void> {
    try {
      const names = await ask<string[]>("files");
      byId("files").replaceChildren(
        ...names.map((name) => {
          const isOpen = name === this.desk.state.name;
          const button = made("button", { type: "button", ...(isOpen ? { disabled: "disabled" } : {}) }, isOpen ? `${name} \u2013 open here` : name);
          button.addEventListener("click", () => void this.open({ name }));
          return made("li", {}, button);
        }),
      );
      byId<HTMLDialogElement>("open-dialog").showModal();
    } catch (error) {
      this.refuse(error as Error);
    }
  }

  private async openText(file?: File): Promise<void> {
    if (file) await this.open({ name: file.name, text: await file.text() });
    input("open-file").value = "";
  }

  /** Open another file; unsaved work of this one is asked about, and kept beside it in any case. */
  private async open(message: { name: string; text?: string; survey?: boolean }): Promise<void> {
    byId<HTMLDialogElement>("open-dialog").close();
    await this.rest();
    const { name, is_saved, can_undo } = this.desk.state;
    if (is_saved || !can_undo) return this.turnTo(message);
    this.ask(`${name} has changes that are not saved. Without saving they stay kept, and are offered when it is opened again.`, [
      ["Save first", () => void this.save().then((isSaved) => (isSaved ? this.turnTo(message) : undefined))],
      ["Open without saving", () => void this.turnTo(message)],
      ["Stay here", () => undefined],
    ]);
  }

  private async turnTo(message: object): Promise<void> {
    try {
      await tell("open", message);
      this.leave();
    } catch (error) {
      this.refuse(error as Error);
    }
  }

  private leave(): void {
    this.isLeaving = true;
    window.location.reload();
  }

  private async build(): Promise<void> {
    const dialog = byId<HTMLDialogElement>("view-dialog");
    byId("view-facts").textContent = "Building\u2026";
    // the viewer starts while the garage is built, and waits for its scene
    byId<HTMLIFrameElement>("view-frame").src = byId<HTMLAnchorElement>("view-link").href = `3d/${this.desk.state.view}/`;
    dialog.showModal();
    try {
      const told = await tell<{ stalls: number }>("build");
      byId("view-facts").textContent = plural(told.stalls, "stall");
    } catch (error) {
      dialog.close();
      this.refuse(error as Error);
    }
  }

  /** See whether the file, or the drawing in another window, has changed. */
  private async look(): Promise<void> {
    if (!this.desk.state || this.desk.isBusy || this.isPainting() || document.hidden) return;
    try {
      const told = await ask<{ changed: boolean; number: number; name: string }>("changed_outside");
      if (this.desk.isBusy || this.isPainting()) return;
      const { name, number } = this.desk.state;
      if (told.number !== number && told.name !== name) return this.leave(); // another window has opened another file
      if (told.changed && byId("notice").hidden)
        this.ask(`${name} was changed by another program.`, [
          ["Take what it has now", () => void this.desk.send("reload")],
          ["Go on with this drawing", () => undefined],
        ]);
      if (told.number !== number) await this.desk.refresh();
    } catch (error) {
      this.refuse(error as Error);
    }
  }
}

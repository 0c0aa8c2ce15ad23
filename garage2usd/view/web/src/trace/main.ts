/** A page on which a garage that exists is traced over a picture, as the survey that `garage2usd import` takes. */

import { ask, Desk, type Finding } from "../draw/desk";
import { byId, FileBar, input, made, plural } from "../draw/file_bar";
import type { Point } from "../draw/sheet";
import { BEGINNING, type Chosen, type Field, FIELDS, lengthOf, nameOf, type PartName, rounded, type Tool, TOOLS, traced, type Traced, type Value } from "./parts";
import { Tracer } from "./tracer";

const CHECK_AFTER_MS = 900;

class TracePage {
  readonly desk: Desk<Traced> = new Desk<Traced>((state) => this.show(state), (error) => this.bar.refuse(error));
  private readonly bar = new FileBar(this.desk, () => this.tracer.isPainting);
  readonly tracer: Tracer;
  private readonly next = structuredClone(BEGINNING);
  private check = 0;

  constructor() {
    this.tracer = new Tracer(document.getElementById("board") as unknown as SVGSVGElement, {
      traced: (tool, points) => void this.trace(tool, points),
      chosen: () => this.showParts(),
      moved: ({ part, at }, value, stroke) =>
        void this.desk.edit(part === "outline" ? { kind: "outline", points: (value as Point[]).map(rounded) } : { kind: "alter", part, at, value }, stroke),
      waits: () => this.hint(),
    });
    for (const tool of TOOLS) {
      const choice = made("input", { type: "radio", name: "tool", value: tool.id });
      choice.checked = tool === this.tracer.tool;
      choice.addEventListener("change", () => this.tracer.take(tool));
      byId("tool-list").append(made("label", { class: "tool" }, choice, tool.name, made("kbd", {}, tool.key)));
    }
    for (const id of ["picture", "picture-share"]) byId(id).addEventListener("change", () => void this.showPicture());
    byId("set-scale").addEventListener("click", () => this.setScale());
    byId("length").addEventListener("keydown", (event) => event.key === "Enter" && this.setScale());
    this.tracer.svg.addEventListener("keydown", (event) => this.key(event));
  }

  async open(): Promise<void> {
    await this.bar.begin();
    this.hint();
    document.documentElement.dataset["ready"] = "yes";
  }

  private show(state: Traced): void {
    this.bar.show(state);
    this.tracer.findings = [];
    this.tracer.show(state);
    this.showParts();
    byId("figures").textContent = `${plural(state.stalls.length, "stall")} drawn`;
    byId("figures").dataset["number"] = String(state.number);
    byId<HTMLButtonElement>("build").disabled = !state.stalls.length;
    window.clearTimeout(this.check);
    if (state.stalls.length) this.check = window.setTimeout(() => void this.checkAll(), CHECK_AFTER_MS);
    else this.showFindings([]);
  }

  /** Import the survey when the drawing rests, which says what a garage of it lacks. */
  private async checkAll(): Promise<void> {
    if (this.desk.isBusy || this.tracer.isPainting) {
      this.check = window.setTimeout(() => void this.checkAll(), CHECK_AFTER_MS);
      return;
    }
    try {
      const told = await ask<{ number: number; findings: Finding[]; stalls: number }>("findings");
      if (told.number !== this.desk.state.number) return;
      this.showFindings(told.findings);
      byId("figures").textContent = `${plural(this.desk.state.stalls.length, "stall")} drawn, ${told.stalls} in the garage`;
      document.documentElement.dataset["checked"] = String(told.number);
    } catch (error) {
      this.bar.refuse(error as Error);
    }
  }

  private showFindings(findings: Finding[]): void {
    this.tracer.findings = findings;
    this.tracer.draw();
    byId("finding-count").textContent = findings.length ? String(findings.length) : "";
    const rows = findings.slice(0, 60).map((finding, number) => {
      const button = made("button", { class: `finding ${finding.severity}` }, made("b", {}, finding.severity), ` ${finding.message}`);
      button.addEventListener("click", () => finding.at && this.tracer.sheet.reveal(finding.at));
      return made("li", { value: number + 1 }, button);
    });
    const none = this.desk.state.stalls.length ? "No findings" : "Trace stalls first";
    byId("findings").replaceChildren(...(rows.length ? rows : [made("li", { class: "none" }, none)]));
  }

  private async trace(tool: Tool, points: Point[]): Promise<void> {
    byId("scale-form").hidden = tool.id !== "scale";
    if (tool.id === "scale") {
      this.tracer.stretch = points;
      input("length").focus();
      return;
    }
    if (tool.id === "outline") await this.desk.edit({ kind: "outline", points: points.map(rounded) });
    else {
      const part = tool.part!;
      const at = this.desk.state.drawing[part]?.length ?? 0;
      const value = { ...this.next[part], ...traced(tool, points) };
      if (await this.desk.edit({ kind: "add", part, value })) this.tracer.choose({ part, at });
    }
  }

  /** Give the picture the scale at which the stretch that was clicked is as long as it is. */
  private setScale(): void {
    const metres = input("length").valueAsNumber;
    const { picture } = this.tracer;
    if (!picture) return this.bar.ask("Choose a picture first; then click the two ends of a length in it.", []);
    if (!(metres > 0) || this.tracer.stretch.length < 2) return void input("length").reportValidity();
    const before = picture.scale;
    picture.scale *= metres / lengthOf(this.tracer.stretch);
    byId("scale-form").hidden = true;
    byId("scale-now").textContent = `1 pixel = ${(100 * picture.scale).toFixed(2)} cm`;
    // the picture stays where it is on the screen, and the parts stay as many metres long
    for (const key of ["x", "z", "scale"] as const) this.tracer.sheet.view[key] *= picture.scale / before;
    this.takeTool("outline");
  }

  private async showPicture(): Promise<void> {
    const file = input("picture").files?.[0];
    const share = input("picture-share").valueAsNumber / 100;
    const { picture } = this.tracer;
    if (picture && picture.url === input("picture").dataset["url"] && picture.share !== share) picture.share = share;
    else if (file) {
      try {
        const { width, height } = await createImageBitmap(file);
        input("picture").dataset["url"] = URL.createObjectURL(file);
        const scale = picture?.scale ?? 60 / width;
        this.tracer.picture = { url: input("picture").dataset["url"]!, width, height, scale, share };
        byId("scale-now").textContent = "Next: click both ends of a length in it that you know.";
        this.tracer.fit();
        this.takeTool("scale");
      } catch {
        this.bar.ask(`${file.name} is not a picture that the browser can show; PNG and JPEG are.`, []);
      }
    }
    this.tracer.draw();
  }

  private takeTool(id: string): void {
    const choice = document.querySelector<HTMLInputElement>(`input[name=tool][value=${id}]`)!;
    choice.checked = true;
    this.tracer.take(TOOLS.find((tool) => tool.id === id)!);
  }

  private hint(): void {
    const { tool, pending, cross } = this.tracer;
    const isNew = tool.id === "select" && !this.tracer.parts.length && !this.tracer.picture;
    const begin = "Choose a picture of the plan at the left, set its scale, then trace the outline, the runs of stalls, lanes and portals";
    const isAsked = this.tracer.stretch.length > 0;
    const said = isNew ? begin : isAsked ? "Scale of picture: type the metres between the two points, at the left" : `${tool.name}: ${tool.hints[Math.min(pending.length, tool.hints.length - 1)]}`;
    if (byId("hint").textContent !== said) byId("hint").textContent = said;
    byId("place").textContent = `Cross at ${cross[0].toFixed(1)}, ${cross[1].toFixed(1)} m`;
  }

  private showParts(): void {
    const { chosen, parts } = this.tracer;
    const state = this.desk.state;
    byId("part-list").replaceChildren(
      ...parts.map((each) => {
        const isChosen = chosen?.part === each.part && chosen.at === each.at;
        const button = made("button", { "aria-pressed": String(isChosen) }, nameOf(each, this.tracer.valueOf(each)!, state.stalls));
        button.addEventListener("click", () => {
          this.takeTool("select");
          this.tracer.choose(isChosen ? null : each);
        });
        return made("li", {}, button);
      }),
    );
    if (!parts.length) byId("part-list").append(made("li", { class: "none" }, "Nothing traced yet"));
    const editor = byId("editor");
    if (editor.contains(document.activeElement) && editor.dataset["of"] === `${chosen?.part} ${chosen?.at}`) return;
    editor.dataset["of"] = `${chosen?.part} ${chosen?.at}`;
    editor.replaceChildren();
    if (!chosen) return editor.append(made("p", { class: "quiet" }, "Select a part, in the plan or in the list, to change or remove it."));
    const value = this.tracer.valueOf(chosen)!;
    editor.append(made("h3", {}, nameOf(chosen, value, state.stalls)));
    for (const field of FIELDS[chosen.part]) if (!field.for || field.for(value as Value)) editor.append(this.field(chosen as Chosen & { part: PartName }, field, value as Value));
    const remove = made("button", {}, "Remove");
    remove.addEventListener("click", () => this.remove());
    editor.append(remove);
  }

  private field(chosen: Chosen & { part: PartName }, field: Field, value: Value): HTMLElement {
    const put = (keys: Value) => {
      for (const [key, each] of Object.entries(keys)) {
        if (each === null) delete this.next[chosen.part][key];
        else if (!["side", "count", "number", "one_way"].includes(key)) this.next[chosen.part][key] = each;
      }
      void this.desk.edit({ kind: "alter", part: chosen.part, at: chosen.at, value: keys }).then(() => this.showAgain());
    };
    const now = value[field.key];
    if (field.choices) {
      const select = made("select", {}, ...field.choices.map((choice) => made("option", {}, choice)));
      select.value = String(now ?? field.choices[0]);
      const more = (kind: string): Value => (field.key !== "kind" || chosen.part !== "runs" ? {} : kind === "angled" ? { angle_deg: 60 } : { angle_deg: null, leans: null });
      select.addEventListener("change", () => put({ [field.key]: select.value, ...more(select.value) }));
      return made("label", { class: "field" }, field.name, select);
    }
    const control = made("input", field.isSwitch ? { type: "checkbox" } : { type: "number", min: 0, step: field.isWhole ? 1 : "any", placeholder: field.placeholder ?? "" });
    if (field.isSwitch) control.checked = now === true;
    else control.value = now === undefined ? "" : String(now);
    control.addEventListener("change", () => put({ [field.key]: field.isSwitch ? control.checked || null : control.value === "" ? null : control.valueAsNumber }));
    return made("label", { class: field.isSwitch ? "field inline" : "field" }, ...(field.isSwitch ? [control, field.name] : [field.name, control]));
  }

  /** Show the settings of the chosen part as they are now, with the focus where it was. */
  private showAgain(): void {
    const at = [...byId("editor").querySelectorAll("input, select")].indexOf(document.activeElement as Element);
    byId("editor").dataset["of"] = "";
    this.showParts();
    if (at >= 0) byId("editor").querySelectorAll<HTMLElement>("input, select")[at]?.focus();
  }

  private remove(): void {
    const { chosen } = this.tracer;
    if (!chosen) return;
    this.tracer.choose(null);
    const { part, at } = chosen;
    void this.desk.edit(part === "outline" ? { kind: "outline", points: null } : { kind: "remove", part, at });
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tracer } = this;
    const steps: Record<string, Point> = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
    const step = steps[event.key];
    const tool = TOOLS.find(({ key }) => key === event.key.toUpperCase());
    const size = event.shiftKey ? 0.1 : 1;
    if (step) tracer.step(step[0] * size, step[1] * size);
    else if (event.key === " ") tracer.put([...tracer.cross]);
    else if (event.key === "Enter") tracer.finish();
    else if (event.key === "Escape") tracer.take(tracer.tool);
    else if (event.key === "Backspace" && tracer.pending.length) tracer.back();
    else if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else if (event.key === "+" || event.key === "=") tracer.sheet.zoom(0.8);
    else if (event.key === "-") tracer.sheet.zoom(1.25);
    else if (event.key === "0") tracer.fit();
    else if (tool) this.takeTool(tool.id);
    else return;
    event.preventDefault();
  }
}

const page = new TracePage();
(window as unknown as { page: TracePage }).page = page;
await page.open();

import { Board, isOn, NAMES, type Shape } from "./board";
import { ask, type Axis, type Control, Desk, type Finding, type Level, type Progress, type Square, type State, tell } from "./desk";
import { byId, FileBar, input, made, plural, select } from "./file_bar";
import { SettingsPanel } from "./settings";

const SHAPES: [Shape, string, string][] = [
  ["squares", "Pencil", "P"], ["rectangle", "Rectangle", "R"], ["flood", "Flood", "F"], ["run", "Stalls", "T"], ["move", "Move plan", "M"],
];
const USES: Record<string, string> = {
  standard: "stall", ev: "charging", accessible: "accessible", access_aisle: "access aisle", turning: "turning bay", unreachable: "not reachable", motorcycle: "motorcycles",
};
const NOT_TO_PARK_IN = ["access_aisle", "turning", "unreachable"];
const CHECK_AFTER_MS = 700;

class DrawPage {
  readonly desk: Desk<State> = new Desk<State>((state) => this.show(state), (error) => this.bar.refuse(error));
  private readonly bar = new FileBar(this.desk, () => this.board.isPainting);
  readonly board: Board;
  private readonly settings: SettingsPanel;
  private level = 0;
  private check = 0;
  private findings: Finding[] = [];
  private isLearning = false;

  constructor({ controls, colours }: { controls: Control[]; colours: Record<string, string> }) {
    this.board = new Board(document.getElementById("board") as unknown as SVGSVGElement, {
      painted: (shape, at, stroke) =>
        void this.desk.edit({ kind: "paint", symbol: this.board.symbol, shape, at, symmetry: this.board.symmetry }, stroke),
      ran: (first, last, point) => this.setRun(first, last, point),
      sized: (axis, metres, stroke) => void this.desk.edit({ kind: "sides", axis, metres }, stroke),
      moved: () => this.tellCursor(),
      found: (finding) => byId(`finding-${finding}`)?.querySelector("button")?.focus(),
    });
    this.settings = new SettingsPanel(byId("settings"), controls, colours, (name, value) => void this.desk.edit({ kind: "put", name, value }));
    this.makeTools();
    this.listen();
  }

  async open(): Promise<void> {
    await this.bar.begin();
    if (this.desk.state.is_working) void this.follow();
    document.documentElement.dataset["ready"] = "yes";
  }

  private show(state: State): void {
    this.findings = state.sketch.findings;
    this.level = Math.min(this.level, state.sketch.levels.length - 1);
    this.board.show(state.sketch, this.level);
    this.settings.show(state);
    this.bar.show(state);
    this.showFigures(state);
    this.showFindings();
    this.showLevels(state);
    this.tellCursor(false);
    window.clearTimeout(this.check);
    if (state.sketch.state === "drawn" || state.sketch.state === "planned")
      this.check = window.setTimeout(() => void this.checkAll(), CHECK_AFTER_MS);
  }

  private showFigures(state: State): void {
    byId<HTMLButtonElement>("plan").disabled = this.isLearning || (state.has_lanes && state.levels === 1) || state.sketch.state === "refused";
    byId<HTMLButtonElement>("build").disabled = state.sketch.state !== "drawn" && state.sketch.state !== "planned";
    byId("adopt").hidden = state.sketch.state !== "planned" || state.levels > 1;
    const { levels, rows_m, cols_m } = state.sketch;
    const stalls = levels.reduce((sum, level) => sum + level.stalls.filter(({ use }) => !NOT_TO_PARK_IN.includes(use)).length, 0);
    const said = { drawn: plural(stalls, "stall"), planned: `${plural(stalls, "stall")}, lanes planned`, open: "no lanes yet: draw them, or plan them", refused: "not a garage yet" };
    const sum = (sides: number[]) => sides.reduce((a, b) => a + b, 0).toFixed(1);
    byId("figures").textContent = `${rows_m.length} \u00d7 ${cols_m.length} squares, ${sum(cols_m)} \u00d7 ${sum(rows_m)} m; ${said[state.sketch.state]}`;
    byId("figures").dataset["seconds"] = String(state.seconds);
    byId("figures").dataset["number"] = String(state.number);
    for (const [id, value] of [["rows", rows_m.length], ["cols", cols_m.length], ["level-count", state.levels]] as const)
      if (document.activeElement !== byId(id)) input(id).value = String(value);
    const uses = new Set(levels.flatMap((level) => level.stalls.map(({ use }) => use)));
    byId("legend").replaceChildren(
      ...Object.entries(USES).flatMap(([use, name]) => (uses.has(use) ? [made("li", {}, made("i", { class: `chip ${use}` }), name)] : [])),
    );
    this.allowLanes(state.levels === 1);
    byId("ramps").hidden = state.levels === 1;
    byId<HTMLButtonElement>("draw-ramp").disabled = !state.place;
    byId<HTMLButtonElement>("free-sides").disabled = !state.given_sides.some(Boolean);
  }

  /** Lanes of several levels are planned, and cannot be painted. */
  private allowLanes(are: boolean): void {
    const choice = document.querySelector<HTMLInputElement>('input[name=symbol][value="="]')!;
    choice.disabled = !are;
    byId("lane-note").hidden = are;
    if (!are && this.board.symbol === "=") this.choose("symbol", ".");
  }

  private showFindings(): void {
    byId("finding-count").textContent = this.findings.length ? String(this.findings.length) : "";
    const several = this.desk.state.sketch.levels.length > 1;
    const rows = this.findings.slice(0, 60).map((finding, number) => {
      const where = finding.at || finding.place ? ` ${several || !finding.at ? finding.place : ""}` : "";
      const button = made("button", { class: `finding ${finding.severity}` }, made("b", {}, finding.severity), ` ${finding.message}${where}`);
      button.addEventListener("click", () => {
        const level = this.desk.state.sketch.levels.findIndex(({ name }) => isOn(finding, name));
        if (level >= 0 && level !== this.level) this.showLevel(level);
        if (finding.at) this.board.reveal(finding.at);
      });
      return made("li", { id: `finding-${number}`, value: number + 1 }, button);
    });
    if (!rows.length) rows.push(made("li", { class: "none" }, "No findings"));
    byId("findings").replaceChildren(...rows);
  }

  private showLevels(state: State): void {
    const host = byId("levels");
    host.hidden = state.sketch.levels.length < 2;
    host.replaceChildren(
      ...state.sketch.levels.map(({ name }, level) => {
        const button = made("button", { "aria-pressed": String(level === this.level) }, name);
        button.addEventListener("click", () => this.showLevel(level));
        return button;
      }),
    );
  }

  private showLevel(level: number): void {
    this.level = level;
    this.board.show(this.desk.state.sketch, level);
    this.showLevels(this.desk.state);
  }

  /** Check with all objects, when the drawing rests. */
  private async checkAll(): Promise<void> {
    const again = () => (this.check = window.setTimeout(() => void this.checkAll(), CHECK_AFTER_MS));
    if (this.desk.isBusy || this.board.isPainting) return void again();
    let told: { number: number; findings: Finding[]; levels: Level[] };
    try {
      told = await ask("findings");
    } catch (error) {
      return this.bar.refuse(error as Error);
    }
    if (told.number !== this.desk.state.number) return; // the answer to the change asks again
    const { sketch } = this.desk.state;
    this.findings = sketch.findings = told.findings;
    // stair cores and turning bays take stalls, which the squares alone do not tell
    if (told.levels.length === sketch.levels.length) sketch.levels = told.levels;
    this.board.show(sketch, this.level);
    this.showFigures(this.desk.state);
    this.showFindings();
    document.documentElement.dataset["checked"] = String(told.number);
    // so that the 3D view is there when its button is pressed, which also says why where it cannot be
    if (!byId<HTMLButtonElement>("build").disabled) void tell("build").catch(() => undefined);
  }

  private tellCursor(speaks = true): void {
    const [row, col] = this.board.cursor;
    const [[first, start], [last, end]] = this.board.selection;
    const kind = NAMES[this.board.symbolAt([row, col])]!;
    const many = first !== last || start !== end ? `, ${(last - first + 1) * (end - start + 1)} selected` : "";
    const said = `Row ${row + 1}, column ${col + 1}: ${kind}${many}`;
    byId("cursor-place").textContent = said;
    if (speaks) byId("spoken").textContent = said;
    const { rows, cols } = this.board.sides;
    if (document.activeElement !== byId("row-side")) input("row-side").value = rows[row]!.toFixed(2);
    if (document.activeElement !== byId("col-side")) input("col-side").value = cols[col]!.toFixed(2);
  }

  private makeTools(): void {
    Object.entries(NAMES).forEach(([symbol, name], number) => {
      const choice = made("input", { type: "radio", name: "symbol", value: symbol });
      choice.checked = symbol === this.board.symbol;
      choice.addEventListener("change", () => (this.board.symbol = symbol));
      byId("symbols").append(made("label", { class: "tool" }, choice, made("i", { class: `chip s${number}` }), name, made("kbd", {}, String(number + 1))));
    });
    for (const [shape, name, key] of SHAPES) {
      const choice = made("input", { type: "radio", name: "shape", value: shape });
      choice.checked = shape === this.board.shape;
      choice.addEventListener("change", () => (this.board.shape = shape));
      byId("shapes").append(made("label", { class: "tool" }, choice, name, made("kbd", {}, key)));
    }
  }

  private choose(name: "symbol" | "shape", value: string): void {
    const choice = document.querySelector<HTMLInputElement>(`input[name=${name}][value="${value}"]`);
    if (!choice || choice.disabled) return;
    choice.checked = true;
    choice.dispatchEvent(new Event("change"));
    byId("spoken").textContent = choice.parentElement!.textContent;
  }

  private setRun(first: Square, last: Square, point?: [number, number]): void {
    const edge = this.board.edgeToLane(first, point);
    if (!edge) return this.bar.ask("Stalls stand on free squares beside a lane; this one has none.", []);
    const [kind, angle] = select("run-kind").value.split(" ");
    const run = kind ? { kind, size: select("run-size").value, ...(angle ? { angle_deg: Number(angle) } : {}) } : null;
    void this.desk.edit({ kind: "run", first, last, edge, run });
  }

  private listen(): void {
    const on = (id: string, act: () => void) => byId(id).addEventListener("click", act);
    const changed = (id: string, act: (value: number) => void) =>
      byId(id).addEventListener("change", () => {
        if (input(id).checkValidity() && input(id).value) act(input(id).valueAsNumber);
        else input(id).reportValidity();
      });
    on("plan", () => void this.learn());
    on("stop", () => void tell("stop"));
    on("adopt", () => void this.desk.send("adopt"));
    byId("symmetry").addEventListener("change", () => {
      this.board.symmetry = select("symmetry").value;
      this.board.draw();
    });
    on("set-run", () => this.setRun(...this.board.selection));
    for (const [axis, name] of [["rows", "row"], ["cols", "col"]] as [Axis, string][]) {
      const line = () => this.board.cursor[axis === "rows" ? 0 : 1];
      on(`insert-${name}`, () => void this.desk.edit({ kind: "insert", axis, after: line() }));
      on(`delete-${name}`, () => void this.desk.edit({ kind: "delete", axis, at: line() }));
      changed(`${name}-side`, (side) => {
        const metres = [...this.board.sides[axis]];
        metres[line()] = side;
        void this.desk.edit({ kind: "sides", axis, metres });
      });
      changed(axis, () => void this.desk.edit({ kind: "resize", rows: input("rows").valueAsNumber, cols: input("cols").valueAsNumber }));
    }
    on("free-sides", () => {
      const stroke = `f${Date.now()}`;
      for (const axis of ["rows", "cols"]) void this.desk.edit({ kind: "sides", axis, metres: null }, stroke);
    });
    changed("level-count", (count) => void this.desk.edit({ kind: "levels", count }));
    on("place-ramp", () => {
      const aside = select("ramp-aside").value || null;
      void this.desk.edit({ kind: "ramps", square: this.board.selection[0], way: select("ramp-way").value, aside });
    });
    on("draw-ramp", () => void this.desk.edit({ kind: "ramps", square: null }));
    for (const id of ["picture", "picture-width", "picture-share", "picture-x", "picture-z"])
      byId(id).addEventListener("change", () => void this.showPicture());
    this.board.svg.addEventListener("keydown", (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const steps: Record<string, Square> = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };
    const step = steps[event.key];
    const shape = SHAPES.find(([, , key]) => key === event.key.toUpperCase());
    if (step) this.board.step(...step, event.shiftKey);
    else if (event.key === " " || event.key === "Enter") this.board.paintSelection();
    else if ("12345".includes(event.key)) this.choose("symbol", Object.keys(NAMES)[Number(event.key) - 1]!);
    else if (shape) this.choose("shape", shape[0]);
    else if (event.key === "+" || event.key === "=") this.board.zoom(0.8);
    else if (event.key === "-") this.board.zoom(1.25);
    else if (event.key === "0") this.board.fit();
    else return;
    event.preventDefault();
  }

  private async learn(): Promise<void> {
    try {
      await tell("learn");
      await this.follow();
    } catch (error) {
      this.bar.refuse(error as Error);
    }
  }

  private async follow(): Promise<void> {
    this.isLearning = true;
    byId("working").hidden = false;
    byId<HTMLButtonElement>("plan").disabled = true;
    let progress: Progress;
    do {
      progress = await ask<Progress>("progress");
      const bar = byId<HTMLProgressElement>("progress");
      if (progress.total) bar.value = progress.done / progress.total;
      else bar.removeAttribute("value");
      byId("progress-text").textContent = `${progress.step} ${progress.total ? Math.round((100 * progress.done) / progress.total) : 0} %, ${progress.seconds.toFixed(0)} s`;
      await new Promise((done) => setTimeout(done, 200));
    } while (progress.is_working);
    this.isLearning = false;
    byId("working").hidden = true;
    if (progress.error && progress.error !== "stopped") this.bar.ask(progress.error, []);
    await this.desk.refresh();
  }

  private async showPicture(): Promise<void> {
    const file = input("picture").files?.[0];
    if (!file) return;
    const { width, height } = await createImageBitmap(file);
    const metres = input("picture-width").valueAsNumber || 1;
    const place = [input("picture-x").valueAsNumber || 0, input("picture-z").valueAsNumber || 0] as const;
    this.board.showPicture(URL.createObjectURL(file), metres, (metres * height) / width, ...place, input("picture-share").valueAsNumber / 100);
  }

}

const page = new DrawPage(await ask<{ controls: Control[]; colours: Record<string, string> }>("controls"));
(window as unknown as { page: DrawPage }).page = page;
await page.open();

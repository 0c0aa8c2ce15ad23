/** Controls of the settings, made from what the server tells of each. */

import type { Control, State } from "./desk";
import { made } from "./file_bar";

type Put = (name: string, value: string | number | boolean | null) => void;
const TITLES: Record<string, string> = { garage: "Garage", floor: "Floor" };

const titled = (name: string) => name.charAt(0).toUpperCase() + name.slice(1);
const inWords = (name: string) => titled(name.split(".").pop()!.replace(/_/g, " ").replace(/ m$/, ", m").replace(/ k$/, ", K"));

export class SettingsPanel {
  private readonly shows: ((values: State["values"], given: string[]) => void)[] = [];
  private readonly drawn: HTMLInputElement;

  constructor(host: HTMLElement, controls: Control[], private readonly colours: Record<string, string>, private readonly put: Put) {
    const groups = new Map<string, Control[]>();
    for (const control of controls) groups.set(control.group, [...(groups.get(control.group) ?? []), control]);
    const [garage, ...looks] = [...groups];
    host.append(made("h2", {}, "Garage"), ...garage![1].map((control) => this.control(control)), made("h2", {}, "Look"));
    this.drawn = made("input", { type: "checkbox" });
    this.drawn.addEventListener("change", () => put("look.drawn", this.drawn.checked ? true : null));
    host.append(made("label", { class: "field inline" }, this.drawn, "Let the seed draw what is not set here"));
    for (const [name, group] of looks)
      host.append(made("details", {}, made("summary", {}, TITLES[name] ?? titled(name)), ...group.map((control) => this.control(control))));
  }

  show(state: State): void {
    this.drawn.checked = state.drawn_look;
    for (const show of this.shows) show(state.values, state.given);
  }

  private control(control: Control): HTMLElement {
    if (control.kind === "colour") return this.colour(control);
    if (control.kind === "choice") {
      const select = made("select", {}, ...control.choices!.map((choice) => made("option", { value: choice }, choice.replace(/_/g, " "))));
      select.addEventListener("change", () => this.put(control.name, select.value));
      this.shows.push((values) => {
        const value = String(values[control.name]);
        if (![...select.options].some((option) => option.value === value)) select.append(made("option", { value }, value));
        select.value = value;
      });
      return made("label", { class: "field", title: control.text }, inWords(control.name), select);
    }
    const input = made("input", control.kind === "switch" ? { type: "checkbox" } : {
      type: "number", min: control.least ?? "", max: control.most ?? "", step: control.kind === "whole" ? 1 : "any",
    });
    input.addEventListener("change", () => {
      if (control.kind === "switch") this.put(control.name, input.checked);
      else this.put(control.name, input.value === "" ? null : Number(input.value));
    });
    this.shows.push((values, given) => {
      if (control.kind === "switch") input.checked = values[control.name] === true;
      else if (document.activeElement !== input) input.value = given.includes(control.name) ? String(values[control.name]) : "";
      input.placeholder = String(values[control.name]);
    });
    const name = control.name === "parking.occupancy" ? "Occupied stalls, share" : inWords(control.name);
    return made("label", { class: control.kind === "switch" ? "field inline" : "field", title: control.text }, ...(control.kind === "switch" ? [input, name] : [name, input]));
  }

  /** Swatches of the named colours, words such as 'natural', and any other colour. */
  private colour(control: Control): HTMLElement {
    const buttons = new Map<string, HTMLButtonElement>();
    const any = made("input", { type: "color", "aria-label": `${inWords(control.name)}: any colour` });
    any.addEventListener("change", () => this.put(control.name, any.value));
    for (const word of control.words ?? []) buttons.set(word, made("button", { type: "button", class: "word" }, word));
    for (const [name, value] of Object.entries(this.colours)) {
      const button = made("button", { type: "button", class: "swatch", "aria-label": name, title: name });
      button.style.background = value;
      buttons.set(value, button);
    }
    for (const [value, button] of buttons) button.addEventListener("click", () => this.put(control.name, value));
    this.shows.push((values) => {
      const now = String(values[control.name]);
      for (const [value, button] of buttons) button.setAttribute("aria-pressed", String(value === now));
      if (now.startsWith("#")) any.value = now;
    });
    const group = made("div", { class: "swatches", role: "group", "aria-label": inWords(control.name), title: control.text }, ...buttons.values(), any);
    return made("div", { class: "field" }, made("span", {}, inWords(control.name)), group);
  }
}

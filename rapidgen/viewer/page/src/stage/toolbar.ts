// Controls of the scene: views, layers, and the handle on a robot's TCP.

import { h } from "../dom";
import type { View } from "../panel";
import type { GripMode } from "./grip";
import { LAYERS, type LayerName, type Stage, type ViewName } from "./stage";

const VIEWS: readonly (readonly [ViewName, string])[] = [["fit", "Fit"], ["front", "Front"], ["side", "Side"], ["top", "Top"]];
const NAMES: Record<LayerName, string> = {
  targets: "Targets", frames: "Frames", ghost: "Commanded position", trail: "Trail", path: "Path", objects: "Objects", tools: "Tools",
  zones: "Zones", shapes: "Collision shapes", distances: "Near misses",
};

/** The row of buttons below the scene. */
export function toolbar(stage: Stage, view: View): HTMLElement {
  const views = VIEWS.map(([name, text]) => h("button", { type: "button", onclick: () => stage.look(name) }, text));
  const clear = h("button", { type: "button", onclick: () => stage.clearTrails() }, "Clear trail");
  const group = (label: string, ...buttons: HTMLElement[]): HTMLElement => h("div", { class: "group", role: "group", "aria-label": label }, ...buttons);
  return h("div", { class: "toolbar" }, group("View", ...views), layers(stage), clear, group("TCP", ...grips(stage, view)));
}

/** A menu of what is drawn. It closes with Escape and when the focus leaves it. */
function layers(stage: Stage): HTMLElement {
  const boxes = (Object.keys(LAYERS) as LayerName[]).map((name) => {
    const box: HTMLInputElement = h("input", { type: "checkbox", checked: LAYERS[name], onchange: () => stage.layer(name, box.checked) });
    return h("label", {}, box, ` ${NAMES[name]}`);
  });
  const menu: HTMLDetailsElement = h("details", {
    class: "layers",
    onkeydown: (event) => {
      if ((event as KeyboardEvent).key === "Escape") menu.open = false;
    },
    onfocusout: (event) => {
      const next = (event as FocusEvent).relatedTarget;
      if (next instanceof Node && !menu.contains(next)) menu.open = false;
    },
  }, h("summary", { class: "button" }, "Layers"), h("div", {}, ...boxes));
  return menu;
}

/** Buttons that put a handle on the TCP of one robot after another. */
function grips(stage: Stage, view: View): HTMLElement[] {
  let held: [string, GripMode] | null = null;
  const show = (): void => {
    for (const own of buttons) own.setAttribute("aria-pressed", String(held !== null && own.dataset["mode"] === held[1]));
  };
  const buttons = (["translate", "rotate"] as const).map((mode) =>
    h("button", { type: "button", class: "commands", "data-mode": mode, "aria-pressed": "false", onclick: () => {
      const names = [...stage.robots.keys()];
      const at = held && held[1] === mode ? names.indexOf(held[0]) + 1 : 0;
      const name = names[at];
      held = name === undefined ? null : [name, mode];
      stage.hold(held?.[0] ?? null, mode);
      show();
    } }, mode === "translate" ? "Drag TCP" : "Turn TCP"));
  const release = (): void => {
    held = null;
    show();
  };
  view.link.on("scene", release);
  view.link.watch((connection) => {
    for (const own of buttons) own.disabled = connection !== "open";
    if (connection === "open" || !held) return;
    stage.hold(null);
    release();
  });
  stage.onwanted = async (robot, position, orientation) => {
    await view.order({ do: "jog-to", group: robot.group.name, frame: "base", position, orientation });
  };
  return buttons;
}

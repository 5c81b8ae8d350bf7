// The page: status bar at the top, scene at the left, panels at the right.

import "./page.css";
import { h, say } from "./dom";
import { EditorLink } from "./editor_link";
import { Link, type Connection } from "./link";
import type { JogTo, Positions, PanelState } from "./messages";
import type { View, MakePanel } from "./panel";
import { axesPanel } from "./panels/axes";
import { connectionsPanel } from "./panels/connections";
import { logPanel } from "./panels/log";
import { pendantPanel } from "./panels/pendant";
import { programPanel } from "./panels/program";
import { recordingPanel } from "./panels/recording";
import { signalsPanel } from "./panels/signals";
import { trajectoryPanel } from "./panels/trajectory";
import type { GripMode } from "./stage/grip";
import { Stage, type ViewName } from "./stage/stage";
import { isDark } from "./stage/palette";
import { Tabs } from "./tabs";

/** Panels in the order of their tabs. */
const PANELS: readonly MakePanel[] = [
  pendantPanel, recordingPanel, programPanel, axesPanel, signalsPanel, logPanel, trajectoryPanel, connectionsPanel,
];

const LOST: Record<Connection, string> = {
  connecting: "", open: "",
  lost: "The connection is lost: what you see is old. Trying again …",
  refused: "This page has no access. Open the link that the program has printed as \"view\".",
};

function stageOrNone(): Stage | null {
  try {
    return new Stage();
  } catch {
    return null;
  }
}

const link = new Link();
let watched = false;
const stage = stageOrNone();
const notices = h("div", { class: "notices", role: "panel", "aria-live": "polite" });
const view: View = {
  link, stage,
  order: (request) => link.ask(request).then(() => true, (why: Error) => {
    view.notice(why.message, "fault");
    return false;
  }),
  notice: (text, kind = "plain") => {
    const note = h("div", { class: `notice ${kind}` }, text);
    notices.append(note);
    setTimeout(() => note.remove(), 6000);
  },
};

// -- the bar --------------------------------------------------------------------------------------

const title = h("strong", {}, "rapidgen");
const chips = { mode: chip(), motors: chip(), program: chip(), time: chip() };
const theme = h("button", { type: "button", class: "quiet", onclick: turnTheme, title: "Light or dark" }, "◐");
const editor = new EditorLink(view);
const bar = h("header", {}, title, ...Object.values(chips), h("span", { class: "space" }), editor.element, theme);
const banner = h("div", { class: "banner", role: "alert", hidden: true });

function chip(): HTMLElement {
  return h("span", { class: "chip" }, "–");
}

function turnTheme(): void {
  document.documentElement.dataset["theme"] = isDark() ? "light" : "dark";
  stage?.paint();
}

const MODES = { auto: "Auto", manual_reduced: "Manual", manual_full: "Manual full speed" };

function showStatus(status: PanelState): void {
  mark(chips.mode, status.mode ? MODES[status.mode] : "Mode unknown", status.mode === "auto" ? "good" : "");
  const stop = status.e_stop ? "Emergency stop" : status.motors_on === null ? "Motors unknown"
    : status.motors_on ? "Motors on" : "Motors off";
  mark(chips.motors, stop, status.e_stop ? "bad" : status.motors_on ? "good" : "");
  const program = held ? "Paused" : status.failed ? "System failure" : status.execution_error ? "Error"
    : watched ? (status.running ? "Can move" : "Cannot move") : status.running ? "Running" : "Stopped";
  mark(chips.program, program, held || status.failed || status.execution_error ? "bad" : status.running ? "good" : "");
  showTime(status.time);
  if (link.isOpen) {
    banner.hidden = status.connected;
    say(banner, "The connection to the robot is lost: what you see is old.");
  }
}

function mark(element: HTMLElement, text: string, kind: "" | "good" | "bad"): void {
  say(element, text);
  element.dataset["kind"] = kind;
}

/** What stands behind the simulated time. */
let estimated = "";

function showTime(time: number): void {
  say(chips.time, `${time.toFixed(1)} s${estimated}`);
}

// -- the robots -----------------------------------------------------------------------------------

const space = h("main", {});

/** Buttons that put a handle on the TCP of one robot after another. */
function grips(stage: Stage): HTMLElement[] {
  let held: [string, GripMode] | null = null;
  const buttons = (["translate", "rotate"] as const).map((mode) => {
    const button: HTMLButtonElement = h("button", { type: "button", class: "commands", "aria-pressed": "false", onclick: () => {
      const names = [...stage.robots.keys()];
      const at = held && held[1] === mode ? names.indexOf(held[0]) + 1 : 0;
      const name = names[at];
      held = name === undefined ? null : [name, mode];
      stage.hold(held?.[0] ?? null, mode);
      for (const own of buttons) own.setAttribute("aria-pressed", String(held !== null && own === button));
    } }, mode === "translate" ? "Drag TCP" : "Turn TCP");
    return button;
  });
  link.on("scene", () => {
    held = null;
    for (const own of buttons) own.setAttribute("aria-pressed", "false");
  });
  let why = "";
  stage.onwanted = async (robot, position, orientation) => {
    const order: JogTo = { do: "jog-to", group: robot.group.name, position, orientation };
    try {
      await link.ask(order);
      why = "";
    } catch (fault) {
      // While it is dragged the same refusal repeats.
      if (why !== (fault as Error).message) view.notice(why = (fault as Error).message, "fault");
    }
  };
  return buttons;
}
if (stage) {
  const names: [ViewName, string][] = [["fit", "Fit"], ["front", "Front"], ["side", "Side"], ["top", "Top"]];
  const views = names.map(([name, text]) =>
    h("button", { type: "button", onclick: () => stage.look(name) }, text));
  const trail = h("button", { type: "button", onclick: () => stage.clearTrails() }, "Clear trail");
  const gap = (): HTMLElement => h("span", { class: "gap" });
  const layers = (["targets", "frames", "ghost"] as const).map((name) => {
    const button: HTMLButtonElement = h("button", { type: "button", "aria-pressed": "true", onclick: () => {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(shown));
      stage.layer(name, shown);
    } }, name[0]?.toUpperCase() + name.slice(1));
    return button;
  });
  const faults = h("details", { class: "faults", hidden: true });
  stage.onfault = () => {
    const list = stage.faults.map((why) => h("li", {}, why));
    faults.hidden = !list.length;
    faults.replaceChildren(h("summary", {}, `Not drawn as described: ${list.length}`), h("ul", {}, ...list));
  };
  space.append(stage.element, faults, h("div", { class: "views", role: "group", "aria-label": "View" },
    ...views, gap(), ...layers, gap(), trail, gap(), ...grips(stage)), stage.labels.element);
  new ResizeObserver(() => stage.resize(space.clientWidth, space.clientHeight)).observe(space);
} else {
  space.append(h("p", { class: "without" },
    "This browser has no WebGL, so the robots are not drawn. Everything else works: " +
    "positions are in the tab Axes."));
}

// -- all ------------------------------------------------------------------------------------------

const panels = PANELS.map((make) => make(view));
const tabs = new Tabs(panels);
document.body.append(bar, banner, h("div", { class: "whole" }, space, tabs.element), notices);

let state: Positions | null = null;
let panel: PanelState | null = null;
let held = false;
link.on("scene", (scene) => {
  say(title, scene.title);
  document.title = `${scene.title} – rapidgen`;
  document.body.dataset["kind"] = scene.kind;
  tabs.fit(scene.kind);
  watched = scene.kind === "robot";
  const notes = scene.kind === "simulation" ? [...new Set(scene.groups.map((group) => group.durations))] : [];
  estimated = notes.length ? ` (${notes.join("; ")})` : "";
  chips.time.title = notes.length ? "Simulated time, and the error of the durations of motions" : "";
  document.body.classList.toggle("reads", !scene.may_command);
  stage?.build(scene);
});
link.on("positions", (now) => {
  state = now;
  stage?.show(now);
  showTime(now.time);
});
link.on("targets", ({ targets }) => stage?.aim(targets));
link.on("panel", (now) => {
  panel = now;
  showStatus(now);
});
link.on("debugging", ({ halt }) => {
  held = halt !== null;
  if (panel) showStatus(panel);
});
link.watch((connection) => {
  document.body.dataset["connection"] = connection;
  if (connection === "connecting") return;
  banner.hidden = connection === "open";
  say(banner, LOST[connection]);
});
addEventListener("hashchange", () => location.reload());
void link.open();

// For tests and the browser's console.
Object.assign(window, {
  rapidgen: { link, stage, editor, state: () => state, panels: Object.fromEntries(panels.map((panel) => [panel.id, panel])) },
});

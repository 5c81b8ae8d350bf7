// The page: header and state at the top, scene at the left, panels at the right.

import "./page.css";
import { h, say } from "./dom";
import { EditorLink } from "./editor_link";
import { Help } from "./help";
import { Link } from "./link";
import type { Positions, PanelState } from "./messages";
import type { View, MakePanel } from "./panel";
import { axesPanel } from "./panels/axes";
import { collisionsPanel } from "./panels/collisions";
import { connectionsPanel } from "./panels/connections";
import { logPanel } from "./panels/log";
import { pendantPanel } from "./panels/pendant";
import { programPanel } from "./panels/program";
import { recordingPanel } from "./panels/recording";
import { signalsPanel } from "./panels/signals";
import { trajectoryPanel } from "./panels/trajectory";
import { Stage } from "./stage/stage";
import { isDark } from "./stage/palette";
import { toolbar } from "./stage/toolbar";
import { StatusBar, stateText, type PageState } from "./status";
import { Tabs } from "./tabs";

/** Panels in the order of their tabs. */
const PANELS: readonly MakePanel[] = [
  pendantPanel, recordingPanel, programPanel, axesPanel, signalsPanel, logPanel, trajectoryPanel, collisionsPanel, connectionsPanel,
];
const KINDS = { simulation: "Simulation", robot: "Real robot, read only", recording: "Recording" };
const MODES = { auto: "Auto", manual_reduced: "Manual", manual_full: "Manual full speed" };

function stageOrNone(): Stage | null {
  try {
    return new Stage();
  } catch {
    return null;
  }
}

const link = new Link();
const stage = stageOrNone();
const status = new StatusBar();
const help = new Help();
const view: View = {
  link, stage,
  order: (request) => link.ask(request).then(() => true, (why: Error) => {
    // Without a connection the state says why.
    if (link.isOpen) status.tell(why.message, "fault");
    return false;
  }),
  notice: (text, kind = "plain") => status.tell(text, kind),
};

// -- the header -----------------------------------------------------------------------------------

const chip = (): HTMLElement => h("span", { class: "chip" }, "–");
const title = h("strong", {}, "rapidgen");
const chips = { kind: chip(), mode: chip(), motors: chip(), program: chip(), time: chip() };
const theme = h("button", { type: "button", class: "quiet", onclick: turnTheme, title: "Light or dark", "aria-label": "Light or dark" }, "◐");
const editor = new EditorLink(view);
const bar = h("header", {}, h("h1", {}, title), ...Object.values(chips), h("span", { class: "space" }), editor.element, help.button, theme);

function turnTheme(): void {
  document.documentElement.dataset["theme"] = isDark() ? "light" : "dark";
  stage?.paint();
}

function showChips({ scene, panel, halt }: PageState): void {
  if (!panel) return;
  const watched = scene?.kind === "robot";
  mark(chips.mode, panel.mode ? MODES[panel.mode] : "Mode unknown", panel.mode === "auto" ? "good" : "");
  const motors = panel.e_stop ? "Emergency stop" : panel.motors_on === null ? "Motors unknown"
    : panel.motors_on ? "Motors on" : "Motors off";
  mark(chips.motors, motors, panel.e_stop ? "bad" : panel.motors_on ? "good" : "");
  const program = halt ? "Paused" : panel.failed ? "System failure" : panel.execution_error ? "Error"
    : watched ? (panel.running ? "Can move" : "Cannot move") : panel.running ? "Running" : "Stopped";
  mark(chips.program, program, panel.failed || panel.execution_error ? "bad" : halt ? "warn" : panel.running ? "good" : "");
}

function mark(element: HTMLElement, text: string, kind: "" | "good" | "warn" | "bad"): void {
  say(element, text);
  element.dataset["kind"] = kind;
}

/** The text after the simulated time: the error of durations. */
let estimated = "";

function showTime(time: number): void {
  say(chips.time, `${time.toFixed(1)} s${estimated}`);
}

// -- the scene ------------------------------------------------------------------------------------

const space = h("div", { class: "scene" });
const main = h("main", {}, space);
if (stage) {
  const faults = h("details", { class: "faults", hidden: true });
  stage.onfault = () => {
    const list = stage.faults.map((why) => h("li", {}, why));
    faults.hidden = !list.length;
    faults.replaceChildren(h("summary", {}, `Not drawn as described: ${list.length}`), h("ul", {}, ...list));
  };
  space.append(stage.element, stage.labels.element, h("div", { class: "notes" }, faults, help.hint));
  main.append(toolbar(stage, view));
  new ResizeObserver(() => stage.resize(space.clientWidth, space.clientHeight)).observe(space);
} else {
  space.append(h("p", { class: "without" },
    "This browser has no WebGL, so the robots are not drawn. Everything else works: positions are in the tab Jog."));
}

// -- all ------------------------------------------------------------------------------------------

const panels = PANELS.map((make) => make(view));
const tabs = new Tabs(panels);
document.body.append(bar, status.element, h("div", { class: "whole" }, main, tabs.element), help.dialog);

let positions: Positions | null = null;
const page: PageState = {
  connection: "connecting", met: false, scene: null, panel: null, halt: null, playback: null, asking: [], contacts: [], modules: null,
};
function update(change: Partial<PageState>): void {
  Object.assign(page, change);
  showChips(page);
  status.show(stateText(page));
  tabs.enable(page.connection === "open");
}

link.on("scene", (scene) => {
  say(title, scene.title);
  document.title = `${scene.title} – rapidgen`;
  document.body.dataset["kind"] = scene.kind;
  mark(chips.kind, KINDS[scene.kind], scene.kind === "robot" ? "warn" : "");
  tabs.fit(scene.kind);
  const notes = scene.kind === "simulation" ? [...new Set(scene.groups.map((group) => group.durations))] : [];
  estimated = notes.length ? ` (${notes.join("; ")})` : "";
  chips.time.title = notes.length ? "Simulated time, and the error of the durations of motions" : "";
  document.body.classList.toggle("reads", !scene.may_command);
  stage?.build(scene);
  help.greet(scene.kind);
  update({ scene, met: true, contacts: [] });
});
link.on("positions", (now) => {
  positions = now;
  stage?.show(now);
  showTime(now.time);
});
link.on("targets", ({ targets, frames }) => stage?.aim(targets, frames));
link.on("panel", (panel: PanelState) => {
  showTime(panel.time);
  update({ panel });
});
link.on("debugging", ({ halt }) => update({ halt }));
link.on("playback", (playback) => update({ playback }));
link.on("dialogs", ({ waiting }) => update({ asking: [...new Set(waiting.map((question) => question.task))] }));
link.on("collisions", ({ near }) => update({
  contacts: near.filter((pair) => pair.verdict === "contact").slice(0, 3).map((pair) => pair.bodies.join(" touches ")),
}));
link.on("loaded", ({ tasks }) => update({ modules: tasks.reduce((sum, task) => sum + Object.keys(task.modules).length, 0) }));
link.watch((connection) => {
  document.body.dataset["connection"] = connection;
  // An attempt to connect again is no state of its own.
  if (connection === "connecting" && page.met) return;
  if (connection === "lost") status.clear();
  update({ connection, met: page.met || connection === "lost" });
});
addEventListener("keydown", (event) => {
  if (event.key !== "F8" || !page.scene?.may_command) return;
  event.preventDefault();
  void view.order({ do: "act", action: "stop" });
});
addEventListener("hashchange", () => location.reload());
void link.open();

// For tests and the browser's console.
Object.assign(window, {
  rapidgen: { link, stage, editor, state: () => positions, panels: Object.fromEntries(panels.map((panel) => [panel.id, panel])) },
});

// The state of the page in one sentence, and beside it one message at a time.
//
// Both have their place below the header, whose height never changes: no message covers a control, and none
// moves one from under the mouse. A repeated message is counted instead of shown again.

import { h, say } from "./dom";
import type { Connection } from "./link";
import type { PanelState, Playback, Scene, SeenHalt } from "./messages";

/** Everything that the sentence depends on. */
export interface PageState {
  connection: Connection;
  /** True once the page has been connected. */
  met: boolean;
  scene: Scene | null;
  panel: PanelState | null;
  halt: SeenHalt | null;
  playback: Playback | null;
  /** Tasks that wait for an answer. */
  asking: readonly string[];
  /** Bodies that touch. */
  contacts: readonly string[];
  /** Number of loaded modules; null: not known. */
  modules: number | null;
}

export type Tone = "plain" | "good" | "warn" | "bad";
/** The state's name (for tests and styles), its tone and its sentence. */
export type StateText = readonly [name: string, tone: Tone, text: string];

const SUBJECTS: Record<Scene["kind"], string> = { simulation: "simulator", robot: "viewer", recording: "viewer" };

/** The most important state first: what it is, and what the user can do. */
export function stateText(page: PageState): StateText {
  const { connection, scene, panel, halt } = page;
  if (connection === "refused")
    return ["refused", "bad", "No access. Open the link that the program printed as “view”."];
  if (connection !== "open" && page.met) {
    const subject = scene ? SUBJECTS[scene.kind] : "server";
    return ["offline", "bad", `The ${subject} has ended or cannot be reached. The page shows its last state and reconnects by itself.`];
  }
  if (!scene) return ["connecting", "plain", "Connecting …"];
  if (scene.kind === "recording")
    return page.playback?.rate ? ["playing", "plain", "Playing a recording."] : ["recording", "plain", "Recording. Press Play, or move the slider."];
  if (!panel) return ["connecting", "plain", "Waiting for the first state …"];
  if (scene.kind === "robot") return robotText(panel);
  if (panel.failed) return ["failed", "bad", "System failure. See the tab Log."];
  if (panel.e_stop)
    return ["e-stop", "bad", "Emergency stop. Press “Reset emergency stop”, then switch the motors on."];
  if (page.contacts.length && !panel.running)
    return ["collision", "bad", `Collision: ${page.contacts.join("; ")}. Move the robot away in the tab Jog.`];
  if (halt) return ["paused", "warn", "Paused: time and robots stand still. Press “Resume”."];
  if (page.asking.length) return ["asking", "warn", `${page.asking.join(", ")} waits for an answer in the tab Pendant.`];
  if (panel.execution_error) return ["error", "bad", "The program stopped with an error. See the tab Log."];
  if (!scene.groups.length) return ["empty", "plain", "No robot is configured. Programs run without motion."];
  if (page.modules === 0) return ["empty", "plain", "No program is loaded."];
  if (!panel.motors_on) return ["motors-off", "warn", "The motors are off. Switch them on to start the program or to move."];
  if (panel.running) return ["running", "good", "The program is running."];
  return ["stopped", "plain", "The program is stopped. Press “Start”, or move the robot in the tab Jog."];
}

function robotText(panel: PanelState): StateText {
  if (!panel.connected) return ["robot-offline", "bad", "The connection to the robot is lost. The page shows its last state."];
  if (panel.e_stop) return ["e-stop", "bad", "Emergency stop of the real robot. Reset it at the controller."];
  if (panel.execution_error) return ["error", "bad", "The controller reports an error. See the tab Log."];
  return panel.running
    ? ["robot", "good", "Real robot, read only. It can move."]
    : ["robot", "plain", "Real robot, read only. It cannot move: the motors are off, or the program is stopped."];
}

const PLAIN = 6_000; // ms that a message is shown
const FAULT = 20_000;

export class StatusBar {
  readonly element: HTMLElement;
  private readonly state = h("p", { class: "state", role: "status" });
  private readonly text = h("span", { class: "text", tabindex: 0 });
  private readonly head = h("b", {});
  private readonly count = h("span", { class: "count" });
  private readonly close = h("button", { type: "button", class: "quiet", "aria-label": "Close the message", onclick: () => this.clear() }, "×");
  private readonly message: HTMLElement;
  private timer = 0;
  private repeated = 0;

  constructor() {
    this.message = h("div", { class: "message", role: "alert", "data-kind": "none", "data-count": 0 }, this.head, this.text, this.count,
      this.close);
    this.element = h("div", { class: "status" }, this.state, this.message);
    this.clear();
  }

  show([name, tone, text]: StateText): void {
    document.body.dataset["state"] = name;
    this.state.dataset["tone"] = tone;
    say(this.state, text);
  }

  /** Show a message instead of the last one; the same again is counted. */
  tell(text: string, kind: "plain" | "fault"): void {
    text = text.charAt(0).toUpperCase() + text.slice(1);
    const again = this.text.textContent === text && this.message.dataset["kind"] === kind;
    this.repeated = again ? this.repeated + 1 : 1;
    say(this.head, kind === "fault" ? "Rejected" : "");
    say(this.text, text);
    say(this.count, this.repeated > 1 ? `${this.repeated} ×` : "");
    this.message.dataset["kind"] = kind;
    this.message.dataset["count"] = String(this.repeated);
    this.close.hidden = false;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.clear(), kind === "fault" ? FAULT : PLAIN);
  }

  clear(): void {
    clearTimeout(this.timer);
    this.repeated = 0;
    say(this.head, "");
    say(this.text, "");
    say(this.count, "");
    this.message.dataset["kind"] = "none";
    this.message.dataset["count"] = "0";
    this.close.hidden = true;
  }
}

// Made of rapidgen/view/messages.py by `python -m tests.view.page_types`; do not edit.

/** A button of the pendant, or something that goes wrong. */
export interface Act {
  readonly do: "act";
  readonly action: "e-stop" | "reset-e-stop" | "motors-on" | "motors-off" | "start" | "stop" | "pp-to-main" | "power-loss";
}

/** What the operator chose or typed. */
export interface AnswerQuestion {
  readonly do: "answer";
  readonly number: number;
  readonly value: string;
}

/** A joint and the controller axis that it drives; limits and speed are the axis' (rad, m). */
export interface Axis {
  readonly name: string;
  readonly axis: string;
  readonly kind: "revolute" | "prismatic";
  readonly lower: number;
  readonly upper: number;
  readonly speed: number;
}

/** All sockets in use. */
export interface Connections {
  readonly type: "connections";
  readonly sockets: readonly ShownSocket[];
}

/** Where a robot is, as text for a program; it is the reply's. */
export interface Copy {
  readonly do: "copy";
  readonly group: string;
  readonly form: "jointtarget" | "robtarget" | "python";
}

/** Cut a connection: the task's socket is reset, and so is the other end. */
export interface Cut {
  readonly do: "cut";
  readonly number: number;
}

/** A dialog that waits; without choices a text or number is typed. */
export interface Dialog {
  readonly number: number;
  readonly task: string;
  readonly dialog: string;
  readonly text: string;
  readonly choices: readonly string[];
}

/** All dialogs that wait. */
export interface Dialogs {
  readonly type: "dialogs";
  readonly waiting: readonly Dialog[];
}

/** A request and the number that its reply will have. */
export interface FromPage {
  readonly id: number;
  readonly request: Act | SetMode | SetOverride | SetPace | AnswerQuestion | Jog | Copy | SetSignal | Cut;
}

/** Put a standing robot elsewhere: controller axes in wire order. */
export interface Jog {
  readonly do: "jog";
  readonly group: string;
  readonly axes: readonly number[];
}

/** Events that are new, oldest first. */
export interface Log {
  readonly type: "log";
  readonly entries: readonly LogEntry[];
}

/** One event with ABB's number. */
export interface LogEntry {
  readonly sequence: number;
  readonly time: number;
  readonly code: number;
  readonly kind: "info" | "warning" | "error";
  readonly title: string;
  readonly texts: readonly string[];
  readonly task: string;
}

/** What the pendant's status bar says. */
export interface PanelState {
  readonly type: "panel";
  readonly time: number;
  readonly mode: "auto" | "manual_reduced" | "manual_full" | null;
  readonly motors_on: boolean | null;
  readonly e_stop: boolean | null;
  readonly execution_error: boolean;
  readonly failed: boolean;
  readonly running: boolean;
  readonly tasks: Readonly<Record<string, string>>;
  readonly override: number;
  readonly pace: number;
}

/** A frame: position m, orientation q1..q4. */
export interface Pose {
  readonly position: readonly [number, number, number];
  readonly orientation: readonly [number, number, number, number];
}

/** Positions. Sent while something moves, and once when it stands. */
export interface Positions {
  readonly type: "positions";
  readonly time: number;
  readonly groups: readonly RobotPlace[];
}

/** The answer to a request; `error` is empty when it was carried out. */
export interface Replied {
  readonly type: "reply";
  readonly id: number;
  readonly error: string;
  readonly text: string;
}

/** Where a robot is. `joints` and `commanded` are URDF values, `axes` the controller's. */
export interface RobotPlace {
  readonly joints: readonly number[];
  readonly commanded: readonly number[];
  readonly axes: readonly number[];
  readonly tcp: Pose | null;
  readonly tool: Pose;
  readonly tool_held: boolean;
  readonly work_object: Pose;
  readonly standing: boolean;
}

/** The first message of a connection, and of a controller that has restarted. */
export interface Scene {
  readonly type: "scene";
  readonly title: string;
  readonly kind: "simulation" | "robot" | "recording";
  readonly may_command: boolean;
  readonly groups: readonly SeenRobot[];
}

/** Rows of the operator window. */
export interface Screen {
  readonly type: "screen";
  readonly rows: readonly string[];
}

/** A robot. `urdf` is its description, whose meshes are paths of this server. */
export interface SeenRobot {
  readonly name: string;
  readonly task: string;
  readonly unit: string;
  readonly urdf: string;
  readonly flange: string;
  readonly movable: readonly string[];
  readonly axes: readonly Axis[];
  readonly has_geometry: boolean;
}

/** Turn the key. */
export interface SetMode {
  readonly do: "mode";
  readonly mode: "auto" | "manual_reduced" | "manual_full";
}

/** Speed of programs, 0..1. */
export interface SetOverride {
  readonly do: "override";
  readonly value: number;
}

/** Simulated seconds in a second; 0 lets time stand. */
export interface SetPace {
  readonly do: "pace";
  readonly value: number;
}

/** Give a signal a value. */
export interface SetSignal {
  readonly do: "signal";
  readonly name: string;
  readonly value: number;
}

/** A signal; `largest` is None where nothing bounds it. */
export interface ShownSignal {
  readonly name: string;
  readonly kind: "DI" | "DO" | "GI" | "GO" | "AI" | "AO";
  readonly device: string;
  readonly value: number;
  readonly largest: number | null;
}

/** A socket of a task. Addresses are empty where there is none. */
export interface ShownSocket {
  readonly number: number;
  readonly task: string;
  readonly status: string;
  readonly local: string;
  readonly peer: string;
}

/** Signals that have changed. */
export interface SignalValues {
  readonly type: "values";
  readonly values: Readonly<Record<string, number>>;
}

/** All signals. */
export interface Signals {
  readonly type: "signals";
  readonly signals: readonly ShownSignal[];
}

export type ToPage = Connections | Dialogs | Log | PanelState | Positions | Replied | Scene | Screen | SignalValues | Signals;

export type Request = Act | AnswerQuestion | Copy | Cut | Jog | SetMode | SetOverride | SetPace | SetSignal;

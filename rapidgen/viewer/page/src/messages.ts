// Made of rapidgen/viewer/messages.py by `python -m tests.viewer.page_types`; do not edit.

/** All signals. */
export interface AllSignals {
  readonly type: "signals";
  readonly signals: readonly ShownSignal[];
}

/** The operator's choice or input. */
export interface AnswerQuestion {
  readonly do: "answer";
  readonly number: number;
  readonly value: string;
}

/** Set a datum, an element or a component in the selected frame. */
export interface Assign {
  readonly do: "assign";
  readonly target: string;
  readonly value: string;
}

/** A joint and its controller axis. Limits and speed are the axis' (rad, m). */
export interface Axis {
  readonly name: string;
  readonly axis: string;
  readonly kind: "revolute" | "prismatic";
  readonly lower: number;
  readonly upper: number;
  readonly speed: number;
}

/** Bodies of collision checks; sent again after a part is gripped or released. */
export interface CollisionBodies {
  readonly type: "bodies";
  readonly bodies: readonly SeenBody[];
  readonly unchecked: readonly string[];
}

/** Distances of bodies nearer than 100 mm, the nearest first. */
export interface Collisions {
  readonly type: "collisions";
  readonly nodes: readonly Pose[];
  readonly near: readonly SeenPair[];
  readonly first: SeenContact | null;
}

/** All sockets in use. */
export interface Connections {
  readonly type: "connections";
  readonly sockets: readonly ShownSocket[];
}

/** Data of sockets, oldest first; only while a viewer listens. */
export interface Conversation {
  readonly type: "conversation";
  readonly listening: boolean;
  readonly lines: readonly SocketLogLine[];
  readonly missed: number;
  readonly fresh: boolean;
}

/** Position of a robot as text for a program, in the reply. */
export interface Copy {
  readonly do: "copy";
  readonly group: string;
  readonly form: "jointtarget" | "robtarget" | "python";
}

/** Start or stop counting executions of lines. */
export interface CountLines {
  readonly do: "cover";
  readonly on: boolean;
}

/** Number of executions of the lines of a text that begin a statement. */
export interface Covered {
  readonly type: "covered";
  readonly source: number;
  readonly lines: Readonly<Record<string, number>>;
}

/** Pause, resume or step a task. */
export interface DebugCommand {
  readonly do: "drive";
  readonly how: "pause" | "resume" | "in" | "over" | "out";
  readonly task: string;
}

/** Breakpoints, the pause, lines of log points, the latest last. */
export interface Debugging {
  readonly type: "debugging";
  readonly halt: SeenHalt | null;
  readonly breakpoints: readonly SeenBreakpoint[];
  readonly errors: "never" | "unhandled" | "all";
  readonly output: readonly string[];
}

/** An open dialog; without choices a text or number is typed. */
export interface Dialog {
  readonly number: number;
  readonly task: string;
  readonly dialog: string;
  readonly text: string;
  readonly choices: readonly string[];
}

/** All open dialogs. */
export interface Dialogs {
  readonly type: "dialogs";
  readonly waiting: readonly Dialog[];
}

/** Place under the cursor of an editor that debugs this simulation. */
export interface EditorPlace {
  readonly type: "editor";
  readonly attached: boolean;
  readonly module: string;
  readonly line: number;
  readonly targets: readonly SeenTarget[];
}

/** The reply's text is the value of an expression in the selected frame. */
export interface Evaluate {
  readonly do: "evaluate";
  readonly expression: string;
}

/** Values of the selected routine, and the watch list. */
export interface FrameValues {
  readonly type: "held";
  readonly task: string;
  readonly level: number;
  readonly variables: readonly SeenValue[];
  readonly watch: readonly SeenValue[];
}

/** Make a connection slow, silent and so on from now on. */
export interface InjectFault {
  readonly do: "inject-fault";
  readonly number: number;
  readonly ailment: "well" | "delay" | "split" | "slow" | "silent" | "half-open";
}

/** Move a robot at rest by its axes in wire order; None: unchanged. `relative`: by so much from its position when the request is executed. */
export interface Jog {
  readonly do: "jog";
  readonly group: string;
  readonly relative: boolean;
  readonly axes: readonly (number | null)[];
}

/** Move the TCP of a robot at rest along and about one axis of a frame, on the same branch. The step starts from the robot's position when the request is executed. */
export interface JogBy {
  readonly do: "jog-by";
  readonly group: string;
  readonly frame: "base" | "tool" | "work_object";
  readonly axis: number;
  readonly distance: number;
  readonly angle: number;
}

/** Move a robot at rest to a TCP pose in a frame, on the same branch. None: unchanged. `base` is the robot's world. */
export interface JogTo {
  readonly do: "jog-to";
  readonly group: string;
  readonly frame: "base" | "work_object";
  readonly position: readonly [number | null, number | null, number | null];
  readonly orientation: readonly [number, number, number, number] | null;
}

/** Start or stop sending the data of sockets. */
export interface Listen {
  readonly do: "listen";
  readonly on: boolean;
}

/** Modules of a task. A text that two tasks share has one number. */
export interface LoadedModules {
  readonly task: string;
  readonly modules: Readonly<Record<string, number>>;
}

/** Loaded programs; their texts are requested by ReadSource. */
export interface LoadedPrograms {
  readonly type: "loaded";
  readonly tasks: readonly LoadedModules[];
}

/** New events, oldest first. */
export interface Log {
  readonly type: "log";
  readonly entries: readonly LogEntry[];
  readonly fresh: boolean;
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

/** Open a line of a module in the editors that debug this simulation. */
export interface OpenInEditor {
  readonly do: "open-in-editor";
  readonly module: string;
  readonly line: number;
}

/** The answer to a request; `error` is empty if it was executed. */
export interface PageReply {
  readonly type: "reply";
  readonly id: number;
  readonly error: string;
  readonly text: string;
}

/** A request and the number of its reply. */
export interface PageRequest {
  readonly id: number;
  readonly request: PendantAction | SetMode | SetOverride | SetPace | AnswerQuestion | Jog | JogTo | JogBy | Copy | SetSignal | OpenInEditor | ResetConnection | InjectFault | Listen | ReadSource | ReadOrigin | SetBreakpoint | RemoveBreakpoint | DebugCommand | RunTo | RunFor | StopOnErrors | SelectFrame | Evaluate | Assign | SetWatch | CountLines | Seek | Play | ReadCurves | UploadTrajectory | RunTrajectory | RemoveTrajectory;
}

/** State of the pendant's status bar. */
export interface PanelState {
  readonly type: "panel";
  readonly time: number;
  readonly mode: "auto" | "manual_reduced" | "manual_full" | null;
  readonly motors_on: boolean | null;
  readonly e_stop: boolean | null;
  readonly e_stop_pressed: boolean | null;
  readonly execution_error: boolean;
  readonly failed: boolean;
  readonly running: boolean | null;
  readonly connected: boolean;
  readonly tasks: Readonly<Record<string, string>>;
  readonly override: number | null;
  readonly pace: number | null;
}

/** A button of the pendant, or an injected fault. */
export interface PendantAction {
  readonly do: "act";
  readonly action: "e-stop" | "release-e-stop" | "reset-e-stop" | "motors-on" | "motors-off" | "start" | "stop" | "pp-to-main" | "power-loss";
}

/** Play at so many seconds in a second; 0 pauses. */
export interface Play {
  readonly do: "play";
  readonly rate: number;
}

/** State of the playback; times in s. `rate` 0: paused. */
export interface Playback {
  readonly type: "playback";
  readonly begin: number;
  readonly end: number;
  readonly time: number;
  readonly rate: number;
  readonly fault: string;
}

/** Program pointers and motion pointers. */
export interface Pointers {
  readonly type: "pointers";
  readonly time: number;
  readonly tasks: readonly TaskPosition[];
}

/** A frame: position m, orientation q1..q4. */
export interface Pose {
  readonly position: readonly [number, number, number];
  readonly orientation: readonly [number, number, number, number];
}

/** Positions, sent during a motion and once at rest. */
export interface Positions {
  readonly type: "positions";
  readonly time: number;
  readonly groups: readonly RobotPlace[];
}

/** The reply's text is PlotData (JSON) of a robot's axes or of a signal. */
export interface ReadCurves {
  readonly do: "curves";
  readonly robot: string;
  readonly signal: string;
  readonly begin: number;
  readonly end: number;
}

/** The reply's text is a SourceOrigin, of a source by its number. */
export interface ReadOrigin {
  readonly do: "origin";
  readonly number: number;
}

/** The reply's text is a source. */
export interface ReadSource {
  readonly do: "source";
  readonly number: number;
}

/** Remove a breakpoint. */
export interface RemoveBreakpoint {
  readonly do: "unbreak";
  readonly number: number;
}

/** Take it off the page. */
export interface RemoveTrajectory {
  readonly do: "forget";
}

/** Cut a connection: the task's socket and its peer are reset. */
export interface ResetConnection {
  readonly do: "cut";
  readonly number: number;
}

/** Position of a robot. `joints` and `commanded` are URDF values, `axes` the controller's. */
export interface RobotPlace {
  readonly joints: readonly number[];
  readonly commanded: readonly number[];
  readonly axes: readonly number[];
  readonly tcp: Pose | null;
  readonly tool: Pose;
  readonly tool_held: boolean;
  readonly work_object: Pose;
  readonly standing: boolean;
  readonly blocked: string;
}

/** Run for so many seconds of the controller's time. */
export interface RunFor {
  readonly do: "run-for";
  readonly seconds: number;
}

/** Run to a line. */
export interface RunTo {
  readonly do: "run-to";
  readonly task: string;
  readonly module: string;
  readonly line: number;
}

/** Execute what was checked, through the simulator's driver. */
export interface RunTrajectory {
  readonly do: "run";
}

/** The first message of a connection, and after a restart. */
export interface Scene {
  readonly type: "scene";
  readonly title: string;
  readonly kind: "simulation" | "robot" | "recording";
  readonly may_command: boolean;
  readonly groups: readonly SeenRobot[];
  readonly things: readonly SeenThing[];
  readonly faults: readonly string[];
}

/** Rows of the operator window. */
export interface Screen {
  readonly type: "screen";
  readonly rows: readonly string[];
}

/** Go to a moment. */
export interface Seek {
  readonly do: "seek";
  readonly time: number;
}

/** A body of collision checks. Its shapes are in the frame of its node. */
export interface SeenBody {
  readonly name: string;
  readonly role: "link" | "tool" | "object" | "part" | "zone";
  readonly node: number;
  readonly shapes: readonly SeenShape[];
}

/** A breakpoint and its line. 0: no line, `doubt` says why. */
export interface SeenBreakpoint {
  readonly number: number;
  readonly task: string;
  readonly module: string;
  readonly line: number;
  readonly condition: string;
  readonly hits: string;
  readonly log: string;
  readonly count: number;
  readonly doubt: string;
}

/** The first contact since the start of the controller; s, m. */
export interface SeenContact {
  readonly time: number;
  readonly bodies: readonly [string, string];
  readonly point: readonly [number, number, number];
  readonly depth: number;
  readonly place: string;
  readonly joints: Readonly<Record<string, readonly number[]>>;
}

/** A declared tool, in the flange, or work object, in the robot's world. */
export interface SeenFrame {
  readonly group: string;
  readonly name: string;
  readonly kind: "tool" | "work_object";
  readonly pose: Pose;
}

/** Reason why all tasks are paused. */
export interface SeenHalt {
  readonly reason: "breakpoint" | "step" | "cursor" | "error" | "pause" | "time";
  readonly task: string;
  readonly place: SeenPlace | null;
  readonly text: string;
  readonly time: number;
}

/** Two bodies that touch or are near each other; m, points in the world. */
export interface SeenPair {
  readonly bodies: readonly [string, string];
  readonly distance: number;
  readonly clearance: number;
  readonly verdict: "contact" | "too near" | "near";
  readonly points: readonly [readonly [number, number, number], readonly [number, number, number]];
}

/** Position in a program. `made` is the template's line of a generated one. */
export interface SeenPlace {
  readonly module: string;
  readonly routine: string;
  readonly line: number;
  readonly made: string;
  readonly level: "program" | "trap" | "event";
}

/** A robot. `urdf` is its description. Meshes are names on this server, empty for missing ones. */
export interface SeenRobot {
  readonly name: string;
  readonly task: string;
  readonly unit: string;
  readonly urdf: string;
  readonly flange: string;
  readonly movable: readonly string[];
  readonly axes: readonly Axis[];
  readonly has_geometry: boolean;
  readonly durations: string;
  readonly base: Pose;
}

/** A shape in its owner's frame. `size`: x, y, z of a box; radius and length; radius; scale of a mesh. */
export interface SeenShape {
  readonly kind: "box" | "cylinder" | "capsule" | "sphere" | "half_space" | "mesh" | "hull";
  readonly size: readonly number[];
  readonly pose: Pose;
  readonly mesh: string;
  readonly corners: readonly (readonly [number, number, number])[];
}

/** Target of a move of a program: the TCP, in the world. */
export interface SeenTarget {
  readonly group: string;
  readonly name: string;
  readonly module: string;
  readonly line: number;
  readonly pose: Pose;
}

/** An object or zone of the cell in the world, or a tool at the flange of a robot. */
export interface SeenThing {
  readonly name: string;
  readonly role: "object" | "tool" | "keep-in" | "keep-out";
  readonly robot: string;
  readonly shapes: readonly SeenShape[];
}

/** A value in RAPID's spelling. */
export interface SeenValue {
  readonly name: string;
  readonly kind: string;
  readonly text: string;
  readonly settable: boolean;
}

/** Show values of a routine of a call stack; -1: the innermost. */
export interface SelectFrame {
  readonly do: "look";
  readonly task: string;
  readonly level: number;
}

/** Set a new breakpoint, or change one; the reply's text is its number. */
export interface SetBreakpoint {
  readonly do: "break";
  readonly number: number;
  readonly module: string;
  readonly line: number;
  readonly task: string;
  readonly condition: string;
  readonly hits: string;
  readonly log: string;
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

/** Simulated seconds in a second. The debugger stops the time (Proceed). */
export interface SetPace {
  readonly do: "pace";
  readonly value: number;
}

/** Set a signal. */
export interface SetSignal {
  readonly do: "signal";
  readonly name: string;
  readonly value: number;
}

/** The watch list. */
export interface SetWatch {
  readonly do: "watch";
  readonly expressions: readonly string[];
}

/** A signal; `largest` is None if it has no maximum. */
export interface ShownSignal {
  readonly name: string;
  readonly kind: "DI" | "DO" | "GI" | "GO" | "AI" | "AO";
  readonly device: string;
  readonly value: number;
  readonly largest: number | null;
}

/** A socket of a task. Addresses are empty if there are none. */
export interface ShownSocket {
  readonly number: number;
  readonly task: string;
  readonly status: string;
  readonly local: string;
  readonly peer: string;
  readonly ailment: "well" | "delay" | "split" | "slow" | "silent" | "half-open";
}

/** Signals that have changed. */
export interface SignalValues {
  readonly type: "values";
  readonly values: Readonly<Record<string, number>>;
}

/** A frame of simple_message, or other bytes. `way` is seen from the program. */
export interface SocketLogLine {
  readonly time: number;
  readonly way: "open" | "in" | "out" | "close";
  readonly task: string;
  readonly local: string;
  readonly peer: string;
  readonly name: string;
  readonly text: string;
  readonly fault: boolean;
}

/** Answer to ReadOrigin: template and line of each generated line. */
export interface SourceOrigin {
  readonly lines: readonly (readonly [number, string, number])[];
  readonly templates: Readonly<Record<string, string>>;
}

/** Errors at which all tasks pause. */
export interface StopOnErrors {
  readonly do: "errors";
  readonly errors: "never" | "unhandled" | "all";
}

/** Targets of the moves of the loaded programs, and their tools and work objects. */
export interface Targets {
  readonly type: "targets";
  readonly targets: readonly SeenTarget[];
  readonly frames: readonly SeenFrame[];
}

/** A task: its call stack, outermost first, and its robot's move. */
export interface TaskPosition {
  readonly name: string;
  readonly state: string;
  readonly stack: readonly SeenPlace[];
  readonly motion: SeenPlace | null;
}

/** An error or warning. `point` counts from 0, None: no single point. */
export interface TrajectoryFinding {
  readonly code: string;
  readonly severity: string;
  readonly message: string;
  readonly help: string;
  readonly line: number | null;
  readonly point: number | null;
}

/** Check a file's text for a robot; the robot does not move. */
export interface UploadTrajectory {
  readonly do: "drop";
  readonly group: string;
  readonly file: string;
  readonly text: string;
}

/** A checked trajectory; the file's name is empty without a file. */
export interface UploadedTrajectory {
  readonly type: "trajectory";
  readonly group: string;
  readonly file: string;
  readonly seconds: number;
  readonly points: number;
  readonly way: readonly (readonly [number, number, number])[];
  readonly pace: readonly number[];
  readonly clearance: readonly number[];
  readonly steps: number;
  readonly findings: readonly TrajectoryFinding[];
  readonly state: "refused" | "checked" | "running" | "done" | "failed";
  readonly detail: string;
}

export type ToPage = AllSignals | CollisionBodies | Collisions | Connections | Conversation | Covered | Debugging | Dialogs | EditorPlace | FrameValues | LoadedPrograms | Log | PageReply | PanelState | Playback | Pointers | Positions | Scene | Screen | SignalValues | Targets | UploadedTrajectory;

export type Request = AnswerQuestion | Assign | Copy | CountLines | DebugCommand | Evaluate | InjectFault | Jog | JogBy | JogTo | Listen | OpenInEditor | PendantAction | Play | ReadCurves | ReadOrigin | ReadSource | RemoveBreakpoint | RemoveTrajectory | ResetConnection | RunFor | RunTo | RunTrajectory | Seek | SelectFrame | SetBreakpoint | SetMode | SetOverride | SetPace | SetSignal | SetWatch | StopOnErrors | UploadTrajectory;

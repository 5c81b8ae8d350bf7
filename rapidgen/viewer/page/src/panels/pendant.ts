// The pendant: emergency stop, mode, motors, stop and start, speed, the operator window with its dialogs.

import { RequestState, type MakePanel } from "../panel";
import { Choice, h, say, section, Rows } from "../dom";
import type { PendantAction, Dialog, PanelState } from "../messages";

const STEPS = [[0.004, "4 ms"], [0.024, "24 ms"], [0.1, "0.1 s"], [1, "1 s"]] as const;
const PACES = [0.1, 0.25, 0.5, 1, 2, 5, 10, 50, 100];

export const pendantPanel: MakePanel = (view) => {
  const { link, order } = view;
  const act = (action: PendantAction["action"]) => () => order({ do: "act", action });
  const button = (text: string, action: PendantAction["action"], kind = ""): HTMLButtonElement =>
    h("button", { type: "button", class: kind, onclick: act(action) }, text);

  const stop = button("Emergency stop", "e-stop", "emergency");
  const reset = button("Reset emergency stop", "reset-e-stop");
  const mode = new Choice<NonNullable<PanelState["mode"]>>("Mode",
    [["auto", "Auto"], ["manual_reduced", "Manual"], ["manual_full", "Manual full speed"]],
    (value) => order({ do: "mode", mode: value }));
  const motors = new Choice<"motors-on" | "motors-off">("Motors",
    [["motors-on", "On"], ["motors-off", "Off"]], (action) => order({ do: "act", action }));

  const speed = h("input", { type: "range", min: 0, max: 100, step: 1, id: "speed", "aria-label": "Speed" });
  const speedText = h("output", { for: "speed" });
  let sliding = false;
  const speeds = new RequestState<number>(view, (now) => {
    if (sliding) return;
    speed.value = String(Math.round(now * 100));
    say(speedText, `${speed.value} %`);
  });
  speed.addEventListener("change", () => {
    sliding = false;
    void speeds.ask({ do: "override", value: Number(speed.value) / 100 });
  });
  speed.addEventListener("input", () => {
    sliding = true;
    say(speedText, `${speed.value} %`);
  });

  // Pausing uses the debugger: the robot rests in the middle of its move, and no program stop occurs.
  let held = false;
  const pause = h("button", { type: "button",
    onclick: () => order({ do: "drive", how: held ? "resume" : "pause", task: "" }) }, "Pause");
  const length = h("select", { "aria-label": "Length of a time step" },
    ...STEPS.map(([value, text]) => h("option", { value }, text)));
  const step = h("button", { type: "button", disabled: true, title: "Run for this time, then pause",
    onclick: () => order({ do: "run-for", seconds: Number(length.value) }) }, "Time step");
  link.on("debugging", ({ halt }) => {
    held = halt !== null;
    say(pause, held ? "Resume" : "Pause");
    step.disabled = !held;
  });
  const pace = h("select", { id: "pace", "aria-label": "Simulation speed" },
    ...PACES.map((value) => h("option", { value, selected: value === 1 }, `${value} ×`)));
  const paces = new RequestState<number>(view, (now) => {
    pace.value = String(PACES.find((value) => value >= now) ?? 100);
  });
  pace.addEventListener("change", () => void paces.ask({ do: "pace", value: Number(pace.value) }));

  const tasks = h("tbody", {});
  const rows = h("pre", { class: "screen", role: "log", "aria-label": "Operator window", tabindex: 0 });
  const dialogs = h("div", { class: "dialogs", "aria-live": "polite" });
  const questions = new Rows<Dialog>(dialogs, (question) => JSON.stringify(question), (question) => ({
    element: dialog(question, (value) => order({ do: "answer", number: question.number, value })),
  }));

  link.on("panel", (now) => {
    stop.classList.toggle("pressed", now.e_stop === true);
    // A disabled button would lose the focus to the whole page.
    if (!now.e_stop && document.activeElement === reset) stop.focus();
    reset.disabled = now.e_stop !== true;
    reset.classList.toggle("primary", now.e_stop === true);
    mode.show(now.mode);
    motors.show(now.motors_on === null ? null : now.motors_on ? "motors-on" : "motors-off");
    speeds.report(now.override ?? 1);
    if (now.pace) paces.report(now.pace);
    tasks.replaceChildren(...Object.entries(now.tasks).map(([name, word]) =>
      h("tr", {}, h("th", { scope: "row" }, name), h("td", { "data-state": word }, word))));
  });
  link.on("screen", (screen) => say(rows, screen.rows.join("\n")));
  link.on("dialogs", ({ waiting }) => {
    questions.show(waiting);
  });

  const element = h("div", { class: "panel" },
    dialogs,
    h("div", { class: "commands stops" }, stop, reset),
    section("Mode", mode.element),
    section("Motors", motors.element),
    section("Program", h("div", { class: "row" },
      button("Start", "start", "primary"), button("Stop", "stop"), button("PP to main", "pp-to-main"))),
    section("Speed", h("label", { class: "row", for: "speed" }, speed, speedText)),
    section("Simulation time", h("div", { class: "row" }, pause, pace, step, length)),
    section("Operator window", rows),
    section("Tasks", h("table", {}, tasks)),
  );
  return { id: "pendant", title: "Pendant", element, kinds: ["simulation", "recording"] };
};

function dialog(question: Dialog, answer: (value: string) => void): HTMLElement {
  const head = h("p", {}, h("b", {}, `${question.task} asks`), " ", question.text);
  if (question.choices.length) {
    return h("div", { class: "dialog" }, head, h("div", { class: "row" }, ...question.choices
      .filter((choice) => choice !== "")
      .map((choice) => h("button", { type: "button", class: "primary", onclick: () => answer(choice) }, choice))));
  }
  const typed = h("input", { type: "text", maxlength: 200, "aria-label": question.text || "Answer" });
  return h("form", {
    class: "dialog",
    onsubmit: (event) => { event.preventDefault(); answer(typed.value); },
  }, head, h("div", { class: "row" }, typed, h("button", { class: "primary" }, "Answer")));
}

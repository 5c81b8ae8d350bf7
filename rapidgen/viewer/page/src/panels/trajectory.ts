// A trajectory of a file: checked, drawn with its speeds, executed by the simulator's driver.

import { h, say, section } from "../dom";
import type { UploadedTrajectory, TrajectoryFinding } from "../messages";
import type { MakePanel } from "../panel";

const FREE = 0.1; // m: clearances above are not measured
const STATES: Record<UploadedTrajectory["state"], string> = {
  refused: "Rejected.", checked: "Ready to execute.", running: "Executing …", done: "Executed.", failed: "Not completed.",
};

export const trajectoryPanel: MakePanel = ({ link, stage, order, notice }) => {
  const robot = h("select", { "aria-label": "Robot" });
  const chosen = h("input", { type: "file", accept: ".csv,.json", "aria-label": "Trajectory file",
    onchange: () => void take(chosen.files?.[0]) });
  const place = h("div", { class: "drop" }, h("p", {}, "Drop a CSV (time,joint names) or JSON file here, or choose one:"), chosen);
  const about = h("p", {});
  const state = h("p", { class: "soft", role: "status" });
  const run = h("button", { type: "button", class: "primary", onclick: () => order({ do: "run" }) }, "Execute");
  const forget = h("button", { type: "button", onclick: () => order({ do: "forget" }) }, "Remove");
  const findings = h("ol", { class: "log" });
  const result = h("section", { hidden: true }, h("h2", {}, "Trajectory"), about, state,
    h("div", { class: "row" }, run, forget), findings);

  const take = async (file: File | undefined): Promise<void> => {
    if (!file) return;
    if (file.size > 900_000) return notice("The file is larger than 900 kB.", "fault");
    order({ do: "drop", group: robot.value, file: file.name, text: await file.text() });
    chosen.value = "";
  };
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (!robot.disabled) void take(event.dataTransfer?.files[0]);
  });

  link.on("scene", (scene) => {
    robot.replaceChildren(...scene.groups.map((group) => h("option", { value: group.name }, group.name)));
    robot.disabled = scene.kind !== "simulation";
    robot.hidden = scene.groups.length < 2;
  });
  link.on("trajectory", (now) => {
    result.hidden = now.file === "";
    const fastest = Math.max(0, ...now.pace);
    say(about, `${now.file}: ${now.points} points in ${now.seconds.toFixed(2)} s` +
      (now.pace.length ? `, TCP up to ${(fastest * 1000).toFixed(0)} mm/s` : "") + clearanceText(now.clearance));
    about.hidden = now.points === 0;
    say(state, now.detail ? `${STATES[now.state]} ${now.detail}` : STATES[now.state]);
    run.disabled = now.state === "refused" || now.state === "running";
    findings.replaceChildren(...now.findings.map(row));
    const marks = now.findings.flatMap((found) => (found.point === null ? [] : [found.point * now.steps]));
    // With collision checks the path shows where it is close, otherwise where it is fast.
    const warmth = now.clearance.length ? now.clearance.map((value) => 1 - Math.max(0, value) / FREE) : now.pace.map((value) => value / Math.max(1e-9, fastest));
    stage?.route(now.group, now.way, warmth, marks);
  });
  const element = h("div", { class: "panel" }, section("Check a trajectory", robot, place), result);
  return { id: "trajectory", title: "Path", element, kinds: ["simulation"] };
};

function clearanceText(clearance: readonly number[]): string {
  if (!clearance.length) return "";
  const least = Math.min(...clearance);
  if (least >= FREE) return ", clearance above 100 mm";
  return least > 0 ? `, least clearance ${(least * 1000).toFixed(1)} mm` : ", in contact";
}

function row(found: TrajectoryFinding): HTMLElement {
  const kind = found.severity === "error" ? "error" : "warning";
  return h("li", { "data-kind": kind }, h("div", { class: "event" }, h("code", {}, found.code), h("span", {}, found.message),
    h("small", {}, found.line === null ? "" : `line ${found.line}`)), found.help ? h("p", {}, found.help) : null);
}

// A recording: scrubbing, playback, and curves with the same cursor.

import type uPlot from "uplot";
import { h, say, section } from "../dom";
import type { Playback, SeenRobot } from "../messages";
import type { MakePanel, View } from "../panel";
import { draw, type PlotData } from "../plot";

const RATES = [0.1, 0.25, 0.5, 1, 2, 5, 10, 50];

export const recordingPanel: MakePanel = (view) => new RecordingPanel(view);

class RecordingPanel {
  readonly id = "recording";
  readonly title = "Recording";
  readonly kinds = ["recording"] as const;
  readonly element: HTMLElement;
  private playback: Playback | null = null;
  private wanted: number | null = null;
  private waiting = false;
  private opened = false;
  private visible = false;
  private drawn = false;
  private charts: uPlot[] = [];
  private data: PlotData | null = null;
  private robots: readonly SeenRobot[] = [];

  private readonly slider = h("input", { type: "range", class: "scrub", step: 0.004, "aria-label": "Time",
    oninput: () => this.seek(Number(this.slider.value)) });
  private readonly moment = h("input", { type: "number", step: 0.004, "aria-label": "Time in seconds",
    onchange: () => this.seek(Number(this.moment.value)) });
  private readonly length = h("span", { class: "soft" });
  private readonly play = h("button", { type: "button", class: "primary", onclick: () => this.run(!this.playback?.rate) }, "Play");
  private readonly rate = h("select", { "aria-label": "Rate", onchange: () => this.run(true) },
    ...RATES.map((value) => h("option", { value, selected: value === 1 }, `${value} ×`)));
  private readonly what = h("select", { "aria-label": "Curve", onchange: () => void this.plot() });
  private readonly span = h("select", { "aria-label": "Span", onchange: () => void this.plot() },
    h("option", { value: 10 }, "10 s"), h("option", { value: 60 }, "1 min"),
    h("option", { value: 0, selected: true }, "All"));
  private readonly video = h("button", { type: "button", onclick: () => this.film() }, "Record video");
  private filming: MediaRecorder | null = null;
  private filmed = 0;
  private readonly curves = h("div", { class: "curves" });
  private readonly cut = h("p", { class: "halt", role: "status", hidden: true });

  constructor(private readonly view: View) {
    const step = (by: number, text: string): HTMLElement => h("button", { type: "button",
      "aria-label": `${Math.abs(by)} s ${by < 0 ? "back" : "forward"}`,
      onclick: () => this.seek((this.playback?.time ?? 0) + by) }, text);
    this.element = h("div", { class: "panel recording" }, this.cut,
      this.slider,
      h("div", { class: "row" }, this.play, this.rate, step(-1, "−1 s"), step(-0.1, "−0.1 s"), this.moment, this.length,
        step(0.1, "+0.1 s"), step(1, "+1 s")),
      section("Curves", h("div", { class: "row" }, this.what, this.span,
        h("button", { type: "button", onclick: () => void this.plot() }, "Draw"),
        h("button", { type: "button", onclick: () => this.csv() }, "Save CSV"),
        h("button", { type: "button", onclick: () => this.png() }, "Save image"), this.video), this.curves),
      h("p", { class: "soft" }, "Click in a curve to go there. `rapidgen view FILE --csv OUT.csv` writes every sample."));
    view.link.on("scene", (scene) => {
      this.robots = scene.groups;
      if (scene.kind === "recording" && !this.opened) document.getElementById(`tab-${this.id}`)?.click();
      this.opened = true;
    });
    view.link.on("signals", ({ signals }) => {
      const chosen = this.what.value;
      const names = [...this.robots.map((robot) => `robot ${robot.name}`), ...signals.map((signal) => `signal ${signal.name}`)];
      if ([...this.what.options].map((option) => option.value).join() === names.join()) return;
      this.what.replaceChildren(...names.map((name) => h("option", { value: name }, name.replace(/^\w+ /, ""))));
      if (names.includes(chosen)) this.what.value = chosen;
    });
    view.link.on("playback", (playback) => this.show(playback));
  }

  shown(visible: boolean): void {
    this.visible = visible;
    if (visible && !this.drawn) void this.plot();
  }

  /** `whole`: including the field with the focus. */
  private show(playback: Playback, whole = false): void {
    this.playback = playback;
    for (const input of [this.slider, this.moment]) {
      input.min = String(playback.begin);
      input.max = String(playback.end);
      const typed = !whole && input === this.moment && document.activeElement === input;
      if (this.wanted === null && !typed) input.value = playback.time.toFixed(3);
    }
    say(this.length, `of ${playback.end.toFixed(1)} s`);
    say(this.play, playback.rate ? "Pause" : "Play");
    this.cut.hidden = !playback.fault;
    say(this.cut, playback.fault);
    if (this.visible && !this.drawn) void this.plot();
    this.cursor();
  }

  /** Go to a moment; during a request only the latest other one is remembered. */
  private seek(time: number): void {
    this.wanted = time;
    if (this.waiting) return;
    this.waiting = true;
    void this.view.link.ask({ do: "seek", time }).then(() => true, (why: Error) => {
      this.view.notice(why.message, "fault");
      return false;
    }).then((done) => {
      this.waiting = false;
      const next = this.wanted;
      this.wanted = null;
      if (next !== null && next !== time) this.seek(next);
      else if (!done && this.playback) this.show(this.playback, true);
    });
  }

  private run(on: boolean): void {
    this.view.order({ do: "play", rate: on ? Number(this.rate.value) : 0 });
  }

  private async plot(): Promise<void> {
    const playback = this.playback;
    if (!playback || !this.what.value) return;
    this.drawn = true;
    const [kind, name = ""] = this.what.value.split(/ (.*)/);
    const half = Number(this.span.value) / 2;
    const [begin, end] = half ? [playback.time - half, playback.time + half] : [playback.begin, playback.end];
    const curves = { robot: kind === "robot" ? name : "", signal: kind === "signal" ? name : "", begin, end };
    try {
      this.data = JSON.parse(await this.view.link.ask({ do: "curves", ...curves })) as PlotData;
    } catch (why) {
      return this.view.notice((why as Error).message, "fault");
    }
    for (const chart of this.charts) chart.destroy();
    this.charts = draw(this.data, this.curves);
    for (const chart of this.charts)
      chart.over.addEventListener("click", (event) => this.seek(chart.posToVal(event.offsetX, "x")));
    // Charts have scales once they are drawn, which they defer until the current task has ended.
    await Promise.resolve();
    this.cursor();
  }

  /** Show the moment in the curves. */
  private cursor(): void {
    const time = this.playback?.time;
    if (time === undefined) return;
    for (const chart of this.charts) chart.setCursor({ left: chart.valToPos(time, "x"), top: 0 }, false);
  }

  private csv(): void {
    if (!this.data) return;
    const curves = this.data.charts.flatMap((chart) => chart.curves);
    const rows = this.data.time.map((time, i) => [time, ...curves.map((curve) => curve.values[i] ?? "")].join(","));
    const quoted = ["time", ...curves.map((curve) => curve.name)].map((name) => `"${name.replaceAll('"', '""')}"`);
    save(new Blob([[quoted.join(","), ...rows].join("\n")], { type: "text/csv" }), "curves.csv");
  }

  private png(): void {
    this.view.stage?.picture((blob) => save(blob, "robots.png"));
  }

  /** Record the scene as WebM until the next click. */
  private film(): void {
    if (this.filming) return this.filming.stop();
    const stage = this.view.stage;
    if (!stage) return this.view.notice("Without WebGL there is no video.", "fault");
    const pieces: Blob[] = [];
    const film = new MediaRecorder(stage.element.captureStream(30), { mimeType: "video/webm" });
    this.filmed = 0;
    film.ondataavailable = (event) => {
      pieces.push(event.data);
      this.filmed += event.data.size;
    };
    film.onstop = () => {
      this.filming = null;
      say(this.video, "Record video");
      save(new Blob(pieces, { type: "video/webm" }), "robots.webm");
    };
    this.filming = film;
    say(this.video, "Stop recording");
    // In pieces, as they are encoded: the film contains the pieces so far.
    film.start(250);
    stage.draw();
  }

  /** For tests. */
  get seen(): { time: number | undefined; charts: number; cursor: number | null | undefined; filmed: number } {
    return { filmed: this.filmed, time: this.playback?.time, charts: this.charts.length, cursor: this.charts[0]?.cursor.left };
  }
}

function save(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

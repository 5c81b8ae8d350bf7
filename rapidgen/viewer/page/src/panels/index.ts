// The panels of the page, in the order of their tabs: a new one is one line here.

import type { MakePanel } from "../panel";
import { axesPanel } from "./axes";
import { connectionsPanel } from "./connections";
import { logPanel } from "./log";
import { pendantPanel } from "./pendant";
import { programPanel } from "./program";
import { recordingPanel } from "./recording";
import { signalsPanel } from "./signals";
import { trajectoryPanel } from "./trajectory";

export const PANELS: readonly MakePanel[] = [pendantPanel, recordingPanel, programPanel, axesPanel, signalsPanel, logPanel, trajectoryPanel, connectionsPanel];

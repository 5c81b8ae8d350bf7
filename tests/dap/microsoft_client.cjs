// A session of Microsoft's test client for debug adapters: node microsoft_client.cjs MODULES PYTHON ADAPTER PROGRAM
"use strict";
const assert = require("node:assert");
const [, , modules, python, adapter, program] = process.argv;
const { DebugClient } = require(`${modules}/@vscode/debugadapter-testsupport`);

async function main() {
  const client = new DebugClient(python, adapter, "rapidgen");
  await client.start();
  client.defaultTimeout = 20000;
  try {
    // The client checks the order of initialize, launch, initialized, breakpoints and configurationDone itself.
    await client.hitBreakpoint({ program, speed: 0 }, { path: program, line: 13 });
    const stack = await client.stackTraceRequest({ threadId: 1 });
    assert.deepStrictEqual(stack.body.stackFrames.map((frame) => frame.line), [13, 8]);
    const frameId = stack.body.stackFrames[0].id;
    const { scopes } = (await client.scopesRequest({ frameId })).body;
    assert.strictEqual(scopes[0].presentationHint, "arguments");
    const read = await client.variablesRequest({ variablesReference: scopes[0].variablesReference });
    assert.deepStrictEqual(read.body.variables.map((one) => one.name), ["n", "word"]);
    await client.setVariableRequest({ variablesReference: scopes[0].variablesReference, name: "n", value: "10" });
    assert.strictEqual((await client.evaluateRequest({ expression: "n * 2", frameId })).body.result, "20");
    await Promise.all([
      client.nextRequest({ threadId: 1 }),
      client.assertStoppedLocation("step", { path: program, line: 14 }),
    ]);
    await client.setBreakpointsRequest({ source: { path: program }, breakpoints: [] });
    await Promise.all([
      client.continueRequest({ threadId: 1 }),
      client.assertOutput("stdout", "T_ROB1: done"),
      client.waitForEvent("terminated"),
    ]);
  } finally {
    await client.stop();
  }
}

main().then(
  () => console.log("passed"),
  (error) => {
    console.error(error);
    process.exit(1);
  },
);

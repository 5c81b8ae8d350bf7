"""Web services: requests, CPU time, threads at the limit, websockets.

    python benchmarks/rws.py [--sockets 19] [--seconds 5]

The controller is a virtual one with T_ROB1 and nothing else, in a process of its own; the client is
another process. `face` is the controller's process: its CPU time for 2,000 requests on one
connection, without its limit of requests. Events: 64 signals at high priority change 20 times a
second in all; the delay is the time that a websocket adds after the change.
"""

import argparse
import json
import multiprocessing
import resource
import ssl
import tempfile
import threading
import time
from dataclasses import replace
from pathlib import Path

from websockets.sync.client import connect

from rapidgen.client.rws import Controller, topics
from rapidgen.client.rws.transport import socket_options
from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.events import WantedResource, read_events, write_wanted
from rapidgen.wire.rws.forms import form_type, write_form

MAIN = """MODULE MainModule
    PERS num x := 1;
    PROC main()
        WHILE TRUE DO
            WaitTime 0.1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""
HIGH, RATE = 64, 20
RELEASE = {Generation.ONE: (6, 15), Generation.TWO: (7, 6), Generation.EIGHT: (7, 6)}


def serve(generation, pipe, strict):
    """Run the controller's process: answer `cpu` and `change`, until `end`."""
    folder = Path(tempfile.mkdtemp())
    (folder / "MainModule.mod").write_text(MAIN)
    signals = tuple(SignalSpec(f"do{i}", "DO", access="All") for i in range(HIGH))
    system = replace(
        read_files([folder / "MainModule.mod"]), robotware=RELEASE[generation], signals=signals
    )
    groups = load_config("irb120").groups
    with ControllerRunner(system, robots=groups, clock="real", autostart=False) as runner:
        runner.start()
        service = serve_rws(runner, generation, strict=strict)
        pipe.send((service.port, service.host_key))
        while (word := pipe.recv()) != "end":
            if word == "cpu":
                usage = resource.getrusage(resource.RUSAGE_SELF)
                pipe.send(usage.ru_utime + usage.ru_stime)
                continue
            name, value = word
            changed = threading.Event()

            def change(name=name, value=value, changed=changed):
                runner.controller.signals[name] = value
                changed.set()

            began = time.monotonic()
            runner.post(change)
            changed.wait()
            pipe.send(began)
        service.close()


class Process:
    """A controller in a process of its own."""

    def __init__(self, generation, strict=True):
        self.pipe, other = multiprocessing.Pipe()
        context = multiprocessing.get_context("spawn")
        self.process = context.Process(target=serve, args=(generation, other, strict))
        self.process.start()
        port, self.fingerprint = self.pipe.recv()
        self.address = f"rws://127.0.0.1:{port}"

    def client(self):
        return Controller(
            self.address, password="robotics", fingerprint=self.fingerprint,
            pin_file=Path(tempfile.mkdtemp()) / "known",
        )  # fmt: skip

    def ask(self, word):
        self.pipe.send(word)
        return self.pipe.recv()

    def end(self):
        self.pipe.send("end")
        self.process.join()


def counted(controller, act):
    before = controller.requests
    act()
    return controller.requests - before


def requests(generation):
    """Count requests of each operation on a warm session, and of its ends."""
    process = Process(generation)
    with process.client() as c:
        result = {"connect": c.requests + 1}  # one more, without an answer: identification
        result |= {
            "one value": counted(c, lambda: c.symbol("T_ROB1/x")),
            "one signal": counted(c, lambda: c.signal("do0")),
            "set a signal": counted(c, lambda: c.set_signal("do0", 1)),
            "set a value": counted(c, lambda: c.set_symbol("T_ROB1/x", 2)),
            "status": counted(
                c, lambda: (c.identity(), c.panel(), c.execution(), c.tasks(), c.pointer("T_ROB1"))
            ),
        }
    process.end()
    return result


def cpu(generation, count=2000):
    """Return ms of CPU of the controller for the most frequent requests."""
    import httpx2

    process = Process(generation, strict=False)
    client = process.client().connect()
    carrier = client._carrier
    http: httpx2.Client = carrier._client
    one = generation is Generation.ONE
    paths = (
        ("/rw/panel/opmode", "/rw/rapid/symbol/data/RAPID/T_ROB1/x", "/rw/iosystem/signals/do0")
        if one
        else (
            "/rw/panel/opmode",
            "/rw/rapid/symbol/RAPID/T_ROB1/x/data",
            "/rw/iosystem/signals/do0",
        )
    )
    headers = {} if one else {"Accept": "application/hal+json;v=2.0"}
    idle = process.ask("cpu")
    time.sleep(1.0)
    idle = process.ask("cpu") - idle
    before, began = process.ask("cpu"), time.monotonic()
    for i in range(count):
        answer = http.get(carrier._base + paths[i % 3], headers=headers, auth=carrier._auth)
        assert answer.status_code == 200
    took = time.monotonic() - began
    spent = process.ask("cpu") - before - idle * took
    client.close()
    process.end()
    return 1000 * spent / count, count / took


def ceiling(generation, threads=8, seconds=10.0):
    """Measure requests of threads that share a client.

    The maximum in any second by the client's clock, and the number that the controller rejected
    (503).
    """
    process = Process(generation)
    sent, refused = [], []
    with process.client() as client:
        carrier = client._carrier
        exchange = carrier._exchange

        def counted_exchange(effect):
            reply = exchange(effect)
            sent.append(time.monotonic())
            refused.extend([effect.target] * (reply.status == 503))
            return reply

        carrier._exchange = counted_exchange
        end = time.monotonic() + seconds

        def ask():
            while time.monotonic() < end:
                client.signal("do0")

        running = [threading.Thread(target=ask) for _ in range(threads)]
        for thread in running:
            thread.start()
        for thread in running:
            thread.join()
    process.end()
    most = max(sum(at <= other < at + 1 for other in sent) for at in sent)
    return {"requests": len(sent), "most in a second": most, "503": len(refused)}


def events(generation, sockets, seconds):
    """Return ms that a websocket adds to a change, and event counts.

    p50, p99, maximum; events received, events lost.
    """
    process = Process(generation, strict=False)
    received, lost, threads = [], [], []
    ready = threading.Barrier(sockets + 1)
    changes = {}
    total = int(seconds * RATE)

    def listen():
        with process.client() as client:
            resources = [topics.signal(f"do{i}").resource(generation) for i in range(HIGH)]
            form = write_form(write_wanted([WantedResource(r, 2) for r in resources]))
            carrier = client._carrier
            headers = {"Content-Type": form_type(generation)}
            if generation is not Generation.ONE:
                headers["Accept"] = "application/hal+json;v=2.0"
            answer = carrier._client.post(
                carrier._base + "/subscription", content=form, headers=headers, auth=carrier._auth
            )
            assert answer.status_code == 201, answer.text
            number = answer.headers["location"].rpartition("/")[2]
            base = carrier._base.replace("http", "ws", 1)
            options = socket_options(client._core, carrier._client.cookies, threads=True)
            assert options["ssl"] is None or isinstance(options["ssl"], ssl.SSLContext)
            with connect(f"{base}/poll/{number}", **options) as socket:
                ready.wait()
                for i in range(total):
                    message = socket.recv(30)
                    received.append((i, time.monotonic(), message))
            ready.wait()

    threads = [threading.Thread(target=listen) for _ in range(sockets)]
    for thread in threads:
        thread.start()
    ready.wait()
    for i in range(total):
        name, value = f"do{i % HIGH}", 1 - (i // HIGH) % 2
        changes[i] = (process.ask((name, value)), name, str(value))
        time.sleep(1 / RATE)
    ready.wait()
    for thread in threads:
        thread.join()
    delays = []
    for i, at, message in received:
        began, name, value = changes[i]
        item = read_events(message.encode())[0]
        if (item.title, item.text("lvalue")) != (name, value):
            lost.append((i, item))
        delays.append(1000 * (at - began))
    delays.sort()
    process.end()
    return {
        "events": len(received),
        "lost": sockets * total - len(received) + len(lost),
        "p50 ms": round(delays[len(delays) // 2], 2),
        "p99 ms": round(delays[int(len(delays) * 0.99)], 2),
        "most ms": round(delays[-1], 2),
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--sockets", type=int, default=19)
    parser.add_argument("--seconds", type=float, default=5.0)
    chosen = parser.parse_args()
    for generation in Generation:
        print(f"RWS {generation.value}: requests {json.dumps(requests(generation))}")
        each, rate = cpu(generation)
        print(f"RWS {generation.value}, 8 threads: {json.dumps(ceiling(generation))}")
        print(f"RWS {generation.value}: {each:.2f} ms of CPU a request, {rate:.0f} a second")
    for generation in Generation:
        text = events(generation, chosen.sockets, chosen.seconds)
        print(f"RWS {generation.value}, {chosen.sockets} websockets: {json.dumps(text)}")


if __name__ == "__main__":
    main()

"""Web services: connections, requests, CPU time, threads at the limit, websockets.

    python benchmarks/rws.py [--sockets 19] [--seconds 5]

The controller is a virtual one with T_ROB1 and nothing else, in a process of its own; the client is
another process. CPU times are those of the controller's process: for 2,000 requests on one
connection without a limit of requests, and for 200 clients, one after the other, that connect, log
in, request once and log out. Events: 64 signals at high priority change 20 times a second in all;
the delay is the time that a websocket adds after the change.
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

import httpx2
from websockets.sync.client import connect

from rapidgen.client.rws import Controller, topics
from rapidgen.config import load_config
from rapidgen.controller.runner import ControllerRunner
from rapidgen.servers.rws.server import serve_rws
from rapidgen.system import read_files
from rapidgen.system.model import SignalSpec
from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.events import PROTOCOLS, WantedResource, read_events, write_wanted
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

    def http(self, generation):
        """Return a client of HTTP alone, logged in by its first request."""
        one = generation is Generation.ONE
        login = (httpx2.DigestAuth if one else httpx2.BasicAuth)("Default User", "robotics")
        return httpx2.Client(
            base_url=self.address.replace("rws", "http" if one else "https"),
            headers={} if one else {"Accept": media.HAL},
            auth=login, verify=unverified(), trust_env=False,
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


def unverified():
    """Return TLS to any server."""
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    return context


def connects(generation, count=200):
    """Return connections a second and ms of CPU of the controller for each."""
    process = Process(generation, strict=False)

    def connect_once():
        with process.http(generation) as http:
            assert http.get("/rw/panel/opmode").status_code == 200
            assert http.get("/logout").status_code == 200

    for _ in range(5):
        connect_once()
    before, began = process.ask("cpu"), time.monotonic()
    for _ in range(count):
        connect_once()
    took, spent = time.monotonic() - began, process.ask("cpu") - before
    process.end()
    return count / took, 1000 * spent / count


def cpu(generation, count=2000):
    """Return the controller's CPU, rate and times of the most frequent requests.

    ms of CPU each, requests a second, p50 and p99 in ms.
    """
    process = Process(generation, strict=False)
    http = process.http(generation)
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
    assert http.get(paths[0]).status_code == 200
    idle = process.ask("cpu")
    time.sleep(1.0)
    idle = process.ask("cpu") - idle
    before, began, times = process.ask("cpu"), time.monotonic(), []
    for i in range(count):
        sent = time.monotonic()
        assert http.get(paths[i % 3]).status_code == 200
        times.append(1000 * (time.monotonic() - sent))
    took = time.monotonic() - began
    spent = process.ask("cpu") - before - idle * took
    http.get("/logout")
    http.close()
    process.end()
    times.sort()
    return 1000 * spent / count, count / took, times[count // 2], times[count * 99 // 100]


def ceiling(generation, threads=8, seconds=10.0):
    """Measure requests of threads that share a client.

    The maximum in any second by the client's clock, and the number that the controller rejected
    (503).
    """
    process = Process(generation)
    sent, refused = [], []
    with process.client() as client:
        runner = client._runner
        exchange = runner._exchange

        def counted_exchange(effect):
            reply = exchange(effect)
            sent.append(time.monotonic())
            refused.extend([effect.target] * (reply.status == 503))
            return reply

        runner._exchange = counted_exchange
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
        with process.http(generation) as http:
            resources = [topics.signal(f"do{i}").resource(generation) for i in range(HIGH)]
            form = write_form(write_wanted([WantedResource(r, 2) for r in resources]))
            headers = {"Content-Type": form_type(generation)}
            assert http.get("/rw/system").status_code == 200
            answer = http.post("/subscription", content=form, headers=headers)
            assert answer.status_code == 201, answer.text
            number = answer.headers["location"].rpartition("/")[2]
            one = generation is Generation.ONE
            base = process.address.replace("rws", "ws" if one else "wss")
            cookies = "; ".join(f"{name}={value}" for name, value in http.cookies.items())
            with connect(
                f"{base}/poll/{number}",
                ssl=None if one else unverified(), additional_headers={"Cookie": cookies},
                subprotocols=[PROTOCOLS[generation]], proxy=None, ping_interval=None,
            ) as socket:  # fmt: skip
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
        rate, each = connects(generation)
        print(f"RWS {generation.value}: {each:.2f} ms of CPU a connection, {rate:.0f} a second")
        each, rate, half, most = cpu(generation)
        print(f"RWS {generation.value}, 8 threads: {json.dumps(ceiling(generation))}")
        print(
            f"RWS {generation.value}: {each:.2f} ms of CPU a request, {rate:.0f} a second, "
            f"p50 {half:.2f} ms, p99 {most:.2f} ms"
        )
    for generation in Generation:
        text = events(generation, chosen.sockets, chosen.seconds)
        print(f"RWS {generation.value}, {chosen.sockets} websockets: {json.dumps(text)}")


if __name__ == "__main__":
    main()

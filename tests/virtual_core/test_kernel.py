"""Clock, events, processes."""

import threading
import time

import pytest

from rapidgen.virtual.kernel import MS, Kernel, Process, WaitSet


def test_events_come_in_order_of_time_then_of_making() -> None:
    kernel, seen = Kernel(), []
    kernel.at(20, lambda: seen.append("c"))
    kernel.at(10, lambda: seen.append("a"))
    kernel.at(10, lambda: seen.append("b"))
    gone = kernel.at(15, lambda: seen.append("never"))
    gone.cancel()
    assert not gone.active
    assert kernel.advance() == "idle"
    assert (seen, kernel.now) == (["a", "b", "c"], 20)


def test_events_see_their_own_time_while_a_process_computes() -> None:
    kernel, seen = Kernel(), []
    process = Process(kernel, "p")
    process.launch(lambda: [process.charge(3 * MS) for _ in range(5)])
    kernel.at(4 * MS, lambda: seen.append(kernel.now))
    kernel.advance()
    assert seen == [4 * MS]
    assert kernel.now == 15 * MS


def test_an_event_made_by_a_running_process_shortens_its_budget() -> None:
    kernel, seen = Kernel(), []
    process = Process(kernel, "p")

    def body() -> None:
        kernel.after(MS, lambda: seen.append(kernel.now))
        process.charge(MS // 2)
        assert not seen
        process.charge(MS)
        assert seen == [MS]

    process.launch(body)
    kernel.advance()
    assert kernel.now == 3 * MS // 2


def test_until_and_stop() -> None:
    kernel = Kernel()
    ticks: list[int] = []

    def tick() -> None:
        ticks.append(kernel.now)
        kernel.after(10, tick)

    kernel.after(10, tick)
    assert kernel.advance(until=35) == "time"
    assert (ticks, kernel.now) == ([10, 20, 30], 35)
    assert kernel.advance(until=1000, stop=lambda: len(ticks) == 5) == "stop"
    assert kernel.now == 50


def test_running_in_pieces_changes_nothing() -> None:
    def order(pieces: int) -> list[str]:
        kernel, seen = Kernel(), []
        for name in "abc":
            process = Process(kernel, name)

            def body(process: Process = process) -> None:
                for _ in range(7):
                    process.charge(MS)
                    seen.append(f"{process.name}{kernel.now}")

            process.launch(body)
        for i in range(1, pieces + 1):
            kernel.advance(until=21 * MS * i // pieces)
        kernel.advance()
        return seen

    assert order(1) == order(13) == order(100)


def test_a_wait_set_wakes_in_order() -> None:
    kernel, seen, done = Kernel(), [], WaitSet()
    for name in "ab":
        process = Process(kernel, name)

        def body(process: Process = process) -> None:
            done.add(process.wake)
            process.block()
            done.remove(process.wake)
            seen.append(process.name)

        process.launch(body)
    kernel.after(5, done.notify)
    kernel.advance()
    assert seen == ["a", "b"]
    assert not done


def test_an_exception_of_a_process_is_not_swallowed() -> None:
    kernel = Kernel()
    process = Process(kernel, "p")
    process.launch(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        kernel.advance()


def test_real_clock_keeps_to_the_wall_and_posts_from_other_threads() -> None:
    kernel, seen = Kernel(clock="real"), []
    kernel.after(50 * MS, lambda: seen.append("timer"))
    thread = threading.Thread(target=lambda: kernel.post(lambda: seen.append("posted")))
    started = time.monotonic()
    thread.start()
    assert kernel.advance(until=100 * MS) == "time"
    thread.join()
    assert 0.09 < time.monotonic() - started < 2
    assert sorted(seen) == ["posted", "timer"]
    kernel.close()


def test_a_machine_that_falls_behind_does_not_make_up_for_it_in_a_burst() -> None:
    kernel = Kernel(clock="real")

    def stall() -> None:
        start, wall = kernel._origin
        kernel._origin = (start, wall - 10_000 * MS)

    kernel.after(1 * MS, stall)
    kernel.after(2 * MS, lambda: None)
    started = time.monotonic()
    kernel.advance(until=500 * MS)
    assert time.monotonic() - started > 0.2
    kernel.close()


def test_speed() -> None:
    kernel = Kernel(clock="real", speed=100)
    started = time.monotonic()
    kernel.advance(until=10_000 * MS)
    assert 0.09 < time.monotonic() - started < 2
    kernel.close()

"""Progress, interrupts, threads and processes."""
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import brume
from conftest import HEIGHT, WIDTH


@pytest.fixture
def slow(context, scene):
    """A plan whose frames take seconds."""
    with brume.Scene({**scene, "quality": "reference"}, context=context) as made, brume.Plan(made, 5 * HEIGHT, 5 * WIDTH) as plan:
        yield plan


@pytest.fixture
def large():
    return np.ones((5 * HEIGHT, 5 * WIDTH, 3), np.float32), np.full((5 * HEIGHT, 5 * WIDTH), 50, np.float32)


def on_thread(function):
    """The result or the exception of a function that another thread calls."""
    found = []

    def work():
        try:
            found.append(function())
        except BaseException as error:
            found.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    return found[0]


def here(function):
    try:
        return function()
    except BaseException as error:
        return error


@pytest.mark.parametrize("call", [here, on_thread])
def test_progress_is_told(context, scene, color, depth, call):
    with brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) as plan:
        told, expected = [], plan(color, depth)
        np.testing.assert_array_equal(call(lambda: plan(color, depth, progress=told.append)), expected)
        assert told and told == sorted(told) and 0 <= told[0] and told[-1] <= 1
        threads = []
        call(lambda: plan(color, depth, progress=lambda _: threads.append(threading.current_thread())))
        assert (set(threads) == {threading.main_thread()}) == (call is here)


@pytest.mark.parametrize("call", [here, on_thread])
def test_progress_cancels(slow, large, call):
    start = time.monotonic()
    assert isinstance(call(lambda: slow(*large, progress=lambda fraction: fraction > 0)), brume.CancelledError)
    assert isinstance(call(lambda: slow(*large, progress=lambda fraction: True)), brume.CancelledError)
    failure = call(lambda: slow(*large, progress=lambda fraction: 1 / 0))
    assert isinstance(failure, ZeroDivisionError)
    assert time.monotonic() - start < 30


def test_a_cancelled_plan_goes_on(context, scene, color, depth):
    with brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) as plan:
        expected = plan(color, depth)
        with pytest.raises(brume.CancelledError):
            plan(color, depth, progress=lambda fraction: True)
        np.testing.assert_array_equal(plan(color, depth), expected)
        for use in (lambda _: plan(color, depth), lambda _: plan.info(), lambda _: context.trim()):
            with pytest.raises(brume.ArgumentError, match="used from its own progress function"):
                plan(color, depth, progress=use)


def test_objects_may_be_thrown_away_during_a_call(context, scene, color, depth):
    kept = [brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) for _ in range(3)]
    with brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) as plan:
        plan(color, depth, progress=lambda _: kept.clear())
        assert kept == [] and not context.session()._dead


@pytest.mark.parametrize("handler", ["interrupt", "alarm"])
def test_ctrl_c_ends_a_frame(slow, large, handler):
    class Alarm(Exception):
        pass

    def ring(*_):
        raise Alarm

    number = signal.SIGINT if handler == "interrupt" else signal.SIGALRM
    previous = signal.signal(number, signal.default_int_handler if handler == "interrupt" else ring)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), number))
    try:
        start = time.monotonic()
        timer.start()
        with pytest.raises(KeyboardInterrupt if handler == "interrupt" else Alarm):
            slow(*large)
        assert 0.2 < time.monotonic() - start < 20
        slow.info()
    finally:
        timer.cancel()
        signal.signal(number, previous)


STORM = """
    import os, signal, sys, threading, time
    import numpy as np
    import brume
    scene = {"camera": {"vertical_fov": 50}, "medium": {"visibility": 100, "g": 0.8}}
    color, depth = np.random.default_rng(1).random((72, 128, 3), np.float32), np.full((72, 128), 20, np.float32)
    plan = brume.Plan(brume.Scene(scene, context=brume.default_context("cpu")), 72, 128)
    expected = plan(color, depth)
    stop, interrupts = threading.Event(), 0

    def storm():
        while not stop.is_set():
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.0007)

    thread = threading.Thread(target=storm)
    end = time.monotonic() + 3
    while True:
        try:
            if not thread.is_alive():
                thread.start()
            while time.monotonic() < end:
                try:
                    # Arrays that go as soon as the call is left.
                    plan(color.copy(), depth.copy(), progress=lambda fraction: None if interrupts % 2 else False)
                except KeyboardInterrupt:
                    interrupts += 1
            break
        except KeyboardInterrupt:
            interrupts += 1
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    stop.set()
    thread.join()
    assert np.array_equal(plan(color, depth), expected)
    print("interrupts" if interrupts > 20 else interrupts)
"""


def test_a_storm_of_interrupts():
    """Wherever they come, nothing hangs and nothing breaks."""
    said = subprocess.run([sys.executable, "-X", "faulthandler", "-c", textwrap.dedent(STORM)], capture_output=True, text=True,
                          timeout=60, check=False)
    assert said.stdout == "interrupts\n", said


def test_threads_share_a_plan(context, scene, color, depth):
    with brume.Plan(brume.Scene(scene, context=context), HEIGHT, WIDTH) as plan:
        pictures = [color * np.float32(k + 1) for k in range(4)]
        expected = [plan(picture, depth) for picture in pictures]
        failures = []

        def work(k):
            for _ in range(20):
                if not np.array_equal(plan(pictures[k], depth), expected[k]):
                    failures.append(k)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert failures == []


def test_other_threads_run_meanwhile(slow, large):
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    marks = []
    try:
        with pytest.raises(brume.CancelledError):
            slow(*large, progress=lambda fraction: marks.append((time.monotonic(), counted[0])) or
                 marks[-1][0] - marks[0][0] > 0.3)
    finally:
        done.set()
        thread.join()
    assert marks[-1][1] - marks[0][1] > 20


def test_messages_are_of_their_own_thread(context, scene):
    with pytest.raises(brume.SceneError, match="first"):
        brume.Scene('{"first": 1}', context=context)
    assert "second" in str(on_thread(lambda: brume.Scene('{"second": 1}', context=context)))


FORK = """
    import os, sys
    import numpy as np
    import brume
    color, depth = np.ones((9, 16, 3), np.float32), np.full((9, 16), 20, np.float32)
    scene = {"camera": {"vertical_fov": 50}, "medium": {"visibility": 100}}
    if "parent" in sys.argv:
        plan = brume.Plan(brume.Scene(scene, context=brume.default_context("cpu")), 9, 16)
        plan(color, depth)
    if os.fork() == 0:
        try:
            fogged = plan(color, depth) if "parent" in sys.argv else brume.fog(color, depth, scene, backend="cpu")
            print("child: fogged", flush=True)
        except brume.UnsupportedError as error:
            print("child:", error, flush=True)
            try:
                brume.Context("cpu")
            except brume.UnsupportedError as error:
                print("child:", error, flush=True)
            del plan
        os._exit(0)
    os.wait()
    brume.fog(color, depth, scene, backend="cpu")
    print("parent: fogged")
"""


def forked(*arguments):
    return subprocess.run([sys.executable, "-c", textwrap.dedent(FORK), *arguments], check=True, capture_output=True, text=True,
                          timeout=60).stdout.splitlines()


def test_fork():
    assert forked() == ["child: fogged", "parent: fogged"]
    said = forked("parent")
    assert len(said) == 3 and said[2] == "parent: fogged"
    assert all("forked" in line and "spawn" in line for line in said[:2])


def test_calibration(context):
    with pytest.raises(brume.CancelledError):
        context.calibrate(lambda fraction: True)
    assert context.calibration() == ""
    with pytest.raises(brume.Error):
        context.set_calibration("of another library")

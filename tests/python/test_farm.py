"""samples/farm without a farm: an sbatch that runs what it is given, chunks that are killed, and the merge."""
import json
import os
import shutil
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import exr

FIRST, LAST = 1001, 1007
SCENE = {"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"visibility": 60, "g": 0.8}}

# Runs arrays at once, one task after the other. FAKE_TASKS: which; FAKE_AFTER: whether jobs that wait for others run.
SBATCH = """#!/usr/bin/env bash
echo "$@" >>"$FAKE_LOG"
array= after= ; for a in "$@"; do case $a in --array=*) array=${a#--array=} ;; --dependency=*) after=yes ;; --output=*) log=${a#--output=} ;; esac; script=$a; done
echo "42;cluster"
if [ -n "$after" ]; then [ -z "${FAKE_AFTER:-}" ] || bash "$script" >"$log" 2>&1 || true; exit 0; fi
range=${array%\\%*}
for task in ${FAKE_TASKS:-$(seq ${range%-*} ${range#*-})}; do
  SLURM_ARRAY_JOB_ID=42 SLURM_ARRAY_TASK_ID=$task bash "$script" >>"${log/\\%a/$task}" 2>&1 || true
done
"""


@pytest.fixture
def farm(tmp_path, tool, source, color, depth, monkeypatch):
    """A folder with a shot and a scene, and a way to submit."""
    (tmp_path / "bin").mkdir()
    for name, text in (("sbatch", SBATCH), ("scontrol", '#!/bin/sh\necho scontrol "$@" >>"$FAKE_LOG"\n')):
        (tmp_path / "bin" / name).write_text(text)
        (tmp_path / "bin" / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    for name, value in {"BRUME": tool, "FAKE_LOG": tmp_path / "slurm.log", "FAKE_AFTER": "yes", "FOG_PAUSE": "0.1"}.items():
        monkeypatch.setenv(name, str(value))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fog.json").write_text(json.dumps(SCENE))
    for number in range(FIRST, LAST + 1):
        picture = color * np.float32(number - FIRST + 1)
        exr.write(tmp_path / f"shot.{number}.exr", {**{c: picture[:, :, i] for i, c in enumerate("RGB")}, "Z": depth})

    class Farm:
        path, stats = tmp_path, tmp_path / "out" / "stats"

        def submit(self, *more, chunk="3"):
            return subprocess.run([os.path.join(source, "samples/farm/submit.sh"), "fog.json", "shot.####.exr", "out/shot.####.exr",
                                   str(FIRST), str(LAST), chunk, *more], capture_output=True, text=True, check=False)

        def merged(self):
            return json.loads((self.stats / "all.json").read_text())

        def log(self):
            return (tmp_path / "slurm.log").read_text() if (tmp_path / "slurm.log").exists() else ""

        def check_frames(self, options=()):
            """They are those of one run that nothing disturbed."""
            subprocess.run([tool, "run", "fog.json", "shot.####.exr", "-o", "alone/shot.####.exr", "--quiet", *options], check=True)
            for number in range(FIRST, LAST + 1):
                assert (tmp_path / "out" / f"shot.{number}.exr").read_bytes() == (tmp_path / "alone" / f"shot.{number}.exr").read_bytes()

    return Farm()


def test_a_sequence(farm):
    said = farm.submit("--", "--layers", "transmittance", "--set", "multiscatter.kernel=paper")
    assert said.returncode == 0 and "job 42: 3 chunks" in said.stdout, said.stderr
    assert "--array=0-2%50" in farm.log() and "--dependency=afterany:42" in farm.log()
    farm.check_frames(["--layers", "transmittance", "--set", "multiscatter.kernel=paper"])
    merged = farm.merged()
    assert [frame["frame"] for frame in merged["frames"]] == list(range(FIRST, LAST + 1)) and merged["parts"] == 3
    assert merged["totals"]["done"] == LAST - FIRST + 1 and merged["totals"]["not_tried"] == 0
    parts = [json.loads(path.read_text()) for path in farm.stats.glob("2*.json")]
    assert merged["totals"]["fog_ms"] == pytest.approx(sum(part["totals"]["fog_ms"] for part in parts))
    assert merged["totals"]["wall_s"] == pytest.approx(sum(part["totals"]["wall_s"] for part in parts))
    assert (farm.stats / "merge.log").read_text() == "7 done, 0 failed, 0 skipped, 0 not tried, by 3 parts\n"
    # Again: nothing is missing, and nothing is done.
    before = {path: path.stat().st_mtime_ns for path in (farm.path / "out").glob("*.exr")}
    assert farm.submit("--", "--layers", "transmittance", "--set", "multiscatter.kernel=paper").returncode == 0
    assert before == {path: path.stat().st_mtime_ns for path in (farm.path / "out").glob("*.exr")}
    assert farm.merged()["totals"]["done"] == LAST - FIRST + 1 and farm.merged()["parts"] == 6


def test_wrong_requests_queue_nothing(farm):
    (farm.path / "fog.json").write_text('{"brume": 1, "medum": {}}')
    said = farm.submit()
    assert said.returncode == 2 and "medum" in said.stderr and farm.log() == ""
    for arguments in ((), ("a", "b", "c", "2", "1"), ("a", "b", "c", "1", "2", "0")):
        script = os.path.join(os.environ["BRUME_SOURCE"], "samples/farm/submit.sh")
        assert subprocess.run([script, *arguments], capture_output=True, check=False).returncode == 2


def test_frames_that_fail(farm):
    good = (farm.path / f"shot.{FIRST + 1}.exr").read_bytes()
    (farm.path / f"shot.{FIRST + 1}.exr").write_bytes(good[:300])
    farm.submit()
    tries = sorted(path.name.split(".")[1:3] for path in farm.stats.glob("2*.json"))
    assert tries == [["0000", "1"], ["0000", "2"], ["0000", "3"], ["0001", "1"], ["0002", "1"]]
    merged = farm.merged()
    assert merged["totals"]["done"] == 6 and merged["totals"]["failed"] == 1
    assert f"frame {FIRST + 1}: " in (farm.stats / "merge.log").read_text()
    # It is there now, and all is well.
    (farm.path / f"shot.{FIRST + 1}.exr").write_bytes(good)
    farm.submit()
    assert farm.merged()["totals"] | {"done": 7, "failed": 0, "skipped": 0, "not_tried": 0} == farm.merged()["totals"]
    farm.check_frames()


def slow_command(farm, tool, monkeypatch, first_lines):
    """The command, with something before it: one whose frames take a while."""
    (farm.path / "slow").write_text(f"#!/bin/bash\n{first_lines}\nexec {tool} \"$@\"\n")
    (farm.path / "slow").chmod(0o755)
    monkeypatch.setenv("BRUME", str(farm.path / "slow"))
    # Frames that take long enough to be caught at it.
    (farm.path / "fog.json").write_text(json.dumps({**SCENE, "quality": "reference"}))
    for path in farm.path.glob("shot.*.exr"):
        exr.write(path, {name: values.repeat(2, 1) for name, values in exr.read(path).items()})


def signal_at_first_frame(farm, number, count):
    """Sends signals to the command when its first frame is there."""
    def work():
        deadline = time.monotonic() + 60
        while not list((farm.path / "out").glob("*.exr")) and time.monotonic() < deadline:
            time.sleep(0.001)
        for pid in (farm.path / "pids").read_text().split()[:count]:
            os.kill(int(pid), number)

    thread = threading.Thread(target=work)
    thread.start()
    return thread


def test_kill_9(farm, tool, monkeypatch):
    slow_command(farm, tool, monkeypatch, f'[ "$1" = run ] && echo $$ >>{farm.path}/pids')
    thread = signal_at_first_frame(farm, signal.SIGKILL, 1)
    assert farm.submit("--", "--jobs", "1", chunk="10").returncode == 0
    thread.join()
    # The killed try left no statistics; the next did what was missing, and found the rest.
    merged = farm.merged()
    assert merged["totals"]["done"] + merged["totals"]["skipped"] == 7 and merged["totals"]["skipped"] >= 1
    assert [path.name.split(".")[2] for path in farm.stats.glob("2*.json")] == ["2"]
    farm.check_frames()


def test_left_overs_of_killed_runs(farm, tool, monkeypatch):
    out = farm.path / "out"
    out.mkdir()
    old, new = out / ".brume-1-0.partial", out / ".brume-1-1.partial"
    old.touch(), new.touch()
    os.utime(old, (time.time() - 7200,) * 2)
    # A process of the same number, as in containers, is not in their way.
    (farm.path / "same").write_text(f'#!/bin/sh\n[ "$1" = run ] && for n in 0 1 2 3 4 5 6 7 8 9; do touch {out}/.brume-$$-$n.partial; done\n'
                                    f'exec {tool} "$@"\n')
    (farm.path / "same").chmod(0o755)
    monkeypatch.setenv("BRUME", str(farm.path / "same"))
    farm.submit()
    assert farm.merged()["totals"]["done"] == 7
    assert not old.exists() and new.exists()
    farm.check_frames()


def test_time_limits(farm, tool, monkeypatch):
    """The shell of a chunk gets the signal; the command ends its frame, and the rest is queued again."""
    slow_command(farm, tool, monkeypatch, f'[ "$1" = run ] && echo $PPID >>{farm.path}/pids')
    monkeypatch.delenv("FAKE_AFTER")
    thread = signal_at_first_frame(farm, signal.SIGTERM, 1)
    farm.submit("--", "--jobs", "1", chunk="10")
    thread.join()
    part, = [json.loads(path.read_text()) for path in farm.stats.glob("2*.json")]
    assert part["totals"]["done"] >= 1 and part["totals"]["not_tried"] >= 1
    assert "scontrol requeue 42_0" in farm.log()
    monkeypatch.setenv("FAKE_AFTER", "yes")
    farm.submit("--", "--jobs", "1", chunk="10")
    assert farm.merged()["totals"]["done"] == 7
    farm.check_frames()


def test_chunks_that_nobody_did(farm, monkeypatch):
    monkeypatch.setenv("FAKE_TASKS", "0 2")
    farm.submit()
    assert farm.merged()["totals"]["not_tried"] == 3
    assert (farm.stats / "merge.log").read_text().startswith("frame 1004: not tried\nframe 1005: not tried\n")
    shutil.rmtree(farm.stats)
    monkeypatch.setenv("FAKE_TASKS", " ")
    farm.submit()
    assert "no chunk has left statistics" in (farm.stats / "merge.log").read_text()


@pytest.mark.parametrize("text, message", [("{", "no statistics; expected what --stats"), ('{"frames": []}', "no statistics"),
                                           (None, "cannot be read; expected"),
                                           ('{"scene": "b", "totals": {}, "frames": []}', 'scene "b"; expected "a", that of'),
                                           ('{"scene": "a", "totals": {}, "frames": [{"frame": 1}]}', "no statistics")])
def test_parts_that_are_none(tool, tmp_path, text, message):
    (tmp_path / "a.json").write_text('{"scene": "a", "totals": {}, "frames": []}')
    if text is not None:
        (tmp_path / "b.json").write_text(text)
    said = subprocess.run([tool, "stats", tmp_path / "a.json", tmp_path / "b.json", "-o", tmp_path / "all.json"], capture_output=True,
                          text=True, check=False)
    assert said.returncode == 2 and f"b.json: {message}" in said.stderr and not (tmp_path / "all.json").exists()

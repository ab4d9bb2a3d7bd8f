"""The examples of docs/python.md, and the sample."""
import json
import os
import re
import subprocess
import sys

import numpy as np


def test_examples_run(source, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    page = os.path.join(source, "docs/python.md")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    blocks = [(match.start(1), match.group(1)) for match in re.finditer(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)]
    assert len(blocks) > 8
    names = {"__name__": "docs"}
    for start, block in blocks:
        # Tracebacks name the page's lines.
        exec(compile("\n" * text.count("\n", 0, start) + block, page, "exec"), names)
    said = capsys.readouterr().out
    comment = re.search(r"print\(error\)\s+# (.*)", text).group(1)
    assert comment in said and "multiscatter/compose" in said
    assert np.isfinite(names["fogged"]).all() and names["planes"].mean() < 1.01


def test_sample_runs(source, tmp_path):
    said = subprocess.run([sys.executable, os.path.join(source, "samples/python/foggy_dataset.py"), tmp_path / "out"], check=True,
                          capture_output=True, text=True).stdout
    assert said.count("arrives straight") == 6 + 1  # the plan says so, too
    labels = json.loads((tmp_path / "out" / "labels.json").read_text())
    shares = [label["transmittance"] for label in labels]
    assert shares == sorted(shares) and (tmp_path / "out" / "sheet.png").stat().st_size > 1000
    pair = np.load(tmp_path / "out" / labels[0]["file"])
    assert pair["foggy"].shape == pair["clear"].shape and pair["foggy"].std() < pair["clear"].std()

"""samples/shafts, as its README runs it, at a quarter of the airlight's resolution."""
import json
import pathlib
import subprocess
import sys

import numpy as np

MAKE = pathlib.Path(__file__).parents[2] / "samples" / "shafts" / "make.py"


def test_shafts_fall_through_the_steam(tmp_path, tool):
    subprocess.run([sys.executable, str(MAKE), str(tmp_path), "2"], check=True)

    def fogged(scene, output):
        subprocess.run([tool, "run", str(scene), str(tmp_path / "hall.####.npy"), "--depth", str(tmp_path / "depth.npy"), "-o",
                        str(tmp_path / output), "--backend", "cpu", "--set", "airlight.orders=single", "--set",
                        "airlight.resolution=quarter"], check=True, capture_output=True)
        return [np.load(tmp_path / output.replace("####", number)) for number in ("0001", "0002")]

    lit = fogged(tmp_path / "shafts.json", "fog.####.npy")
    scene = json.loads((tmp_path / "shafts.json").read_text())
    del scene["lights"][0]["shadow"]
    (tmp_path / "open.json").write_text(json.dumps(scene))
    without = fogged(tmp_path / "open.json", "open.####.npy")
    # The grating takes half of the light. Beside the lamp all is in its cone, and bars are between the shafts,
    # which go up and down more than once along a row.
    for shafts, whole in zip(lit, without):
        assert np.isfinite(shafts).all()
        assert 0.2 < shafts[60:150].mean() / whole[60:150].mean() < 0.8
        up_and_down = [np.abs(np.diff(row)).sum() / row.max() for row in (shafts[110, 150:450, 1], whole[110, 150:450, 1])]
        assert up_and_down[0] > 1.5 * up_and_down[1]
    assert not np.array_equal(lit[0], lit[1])

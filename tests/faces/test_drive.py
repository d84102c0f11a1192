"""The live simulator: a real server and, where there is one, a real browser."""

from __future__ import annotations

import asyncio
import io
import json
import re
import signal
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import magwire as mw
from browsers import started
from magwire.actuate import Helmholtz, Pair
from magwire.cli import main
from magwire.contact.motion import gone
from magwire.drive import DEAD_MAN, DriveError, Outcome, serve
from magwire.drive.doors import Doors
from magwire.navigate import NavigationError
from magwire.view.content import motions
from records import BREATHING

pytest.importorskip("websockets", reason="websockets is not installed")

WAIT = 120.0  # longest time for anything, compiling among it [s]
SPEED = 4e-3


def simulation(tree: bool = False) -> mw.Simulation:
    wire = mw.Wire.uniform(
        length=0.1,
        radius=0.6e-3,
        youngs_modulus=3e6,
        shear_modulus=1e6,
        density=2000.0,
        nodes=40,
        magnetized_tip=5e-3,
        magnetization=128e3,
    )
    bend = mw.Lumen.half_circle(centreline_radius=0.025, radius=3e-3)
    if not tree:
        return mw.Simulation(wire, bend)
    ahead = mw.Lumen.straight(0.08, 3e-3)
    return mw.Simulation(wire, mw.Lumen.tree({"ahead": ahead, "aside": bend}, target="ahead"))


class Served:
    """A server in a thread of its own."""

    def __init__(self, folder: Path, made: mw.Simulation, **options: Any) -> None:
        self.file = folder / "result.nc"
        self.outcome: Outcome | None = None
        self.error: BaseException | None = None
        self._ready = threading.Event()
        self.address = ""
        self._thread = threading.Thread(target=self._run, args=(made, options), daemon=True)
        self._thread.start()
        assert self._ready.wait(WAIT), self.error

    def _run(self, made: mw.Simulation, options: dict[str, Any]) -> None:
        try:
            self.outcome = serve(made, out=self.file, port=0, ready=self._open, **options)
        except BaseException as error:
            self.error = error
            self._ready.set()

    def _open(self, address: str) -> None:
        self.address = address
        self._ready.set()

    @property
    def host(self) -> str:
        return self.address.removeprefix("http://").split("/")[0]

    def end(self) -> mw.Result:
        """Wait for the end, which somebody has asked for."""
        self._thread.join(WAIT)
        assert not self._thread.is_alive()
        if self.error is not None:
            raise self.error
        return mw.Result.load(self.file)


class Hand:
    """A page without a browser."""

    def __init__(self, line: Any) -> None:
        self.line = line
        self.number = 0
        self.role: dict[str, bool] = {}
        self.pictures: list[dict[str, Any]] = []
        self.said: list[str] = []
        self.world: dict[str, Any] = {}
        self.report: dict[str, Any] = {}

    async def say(self, **message: Any) -> int:
        self.number += 1
        await self.line.send(json.dumps(message | {"number": self.number}))
        return self.number

    async def hear(self, until: Callable[[], Any]) -> None:
        async with asyncio.timeout(WAIT):
            while not until():
                message = json.loads(await self.line.recv())
                self.world = message.get("world", self.world)
                self.role = message.get("role", self.role)
                self.report = message.get("report", self.report)
                if "picture" in message:
                    self.pictures.append(message["picture"])
                if "said" in message:
                    self.said.append(message["said"])

    async def heard(self, number: int) -> dict[str, Any]:
        """The first picture after something that was said."""
        await self.hear(lambda: self.pictures and self.pictures[-1]["heard"] >= number)
        return self.pictures[-1]


def connect(served: Served, origin: str | None = None) -> Any:
    from websockets.asyncio.client import connect

    address = served.address.replace("http://", "ws://").replace("/?", "/live?")
    if not served.address.endswith("/"):
        return connect(address, origin=origin or f"http://{served.host}", proxy=None)
    return connect(f"{address}live", origin=origin or f"http://{served.host}", proxy=None)


def test_what_is_held_is_fed_and_recorded(tmp_path: Path) -> None:
    """By the stamps of the recording; and a lost connection stops the wire."""
    served = Served(tmp_path, simulation())

    async def drive() -> None:
        async with connect(served) as line:
            hand = Hand(line)
            await hand.hear(lambda: hand.pictures)
            assert hand.role == {"drives": True, "free": False}
            for _ in range(4):  # said again in time
                await hand.heard(await hand.say(hold=[SPEED, 0.5]))
                await asyncio.sleep(0.1)
            there = await hand.heard(await hand.say(hold=[0.0, 0.0]))
            assert there["feed"] > 0.0
            await hand.heard(await hand.say(hold=[SPEED, 0.0]))
            await asyncio.sleep(2.0 * DEAD_MAN)  # silence, as when a line is cut
            await hand.heard(await hand.say(hold=[SPEED, 0.0]))
            line.transport.abort()
        async with connect(served) as line:  # the first one is gone with its hand on the key
            hand = Hand(line)
            await hand.hear(lambda: hand.pictures and hand.role.get("drives"))
            await asyncio.sleep(2.0 * DEAD_MAN)
            first = await hand.heard(await hand.say(limit=1.0))
            last = await hand.heard(await hand.say(limit=1.0))
            assert first["feed"] == last["feed"]
            await hand.say(end=True)
            await hand.hear(lambda: hand.report)
        assert hand.report["rows"]["recorded to"] == str(served.file)

    asyncio.run(drive())
    result = served.end()
    assert result.status == "complete"
    assert served.outcome is not None
    course = np.loadtxt(served.file.with_name("hands.csv"), delimiter=",", skiprows=1)
    assert [row[1] > 0 for row in course] == [True, False, True, False, True, False]
    stamps = np.append(course[:, 0], result.time[-1])
    fed = np.concatenate([[0.0], np.cumsum(course[:, 1] * np.diff(stamps))])
    recorded = np.interp(stamps, result.time, result.feed)
    # Within one step where a record is at the stamp; records are 0.1 s apart.
    assert fed[-1] == pytest.approx(result.feed[-1], abs=SPEED * 0.01)
    assert np.abs(fed - recorded).max() <= SPEED * 0.1
    for begin in (2, 4):
        assert course[begin + 1, 0] - course[begin, 0] <= DEAD_MAN + 0.02
    for time_, feed in zip(result.time, result.feed, strict=True):
        assert np.interp(time_, stamps, fed) == pytest.approx(feed, abs=SPEED * 0.01)


def test_pages_take_turns_and_absurd_words_change_nothing(tmp_path: Path) -> None:
    served = Served(tmp_path, simulation())

    async def drive() -> None:
        async with connect(served) as line, connect(served) as other:
            first, second = Hand(line), Hand(other)
            await first.hear(lambda: first.pictures)
            await second.hear(lambda: second.role)
            assert second.role == {"drives": False, "free": False}
            await second.say(hold=[SPEED, 0.0])
            await second.hear(lambda: second.said)
            assert second.said == ["Another page drives: take the controls first."]
            before = first.pictures[-1]
            absurd = [
                '{"hold": [1e300, 0]}',
                '{"hold": [NaN, 0]}',
                '{"hold": "fast"}',
                '{"hold": [[1], [2]]}',
                '{"field": [1, 2]}',
                '{"field": [5, 0, 0]}',
                '{"limit": -1}',
                '{"limit": null}',
                '{"rewind": 0}',
                '{"help": "magic"}',
                '{"target": "moon"}',
                '{"hold": [0, 0], "rewind": 1}',
                "[" * 1000,
                "no JSON",
                "{}",
            ]
            for count, words in enumerate(absurd, 1):
                await first.line.send(words)
                await first.hear(lambda count=count: len(first.said) >= count)
            assert not any("Traceback" in words for words in first.said)
            assert "speeds of at most 0.04; received 1e+300" in first.said[0]
            after = await first.heard(await first.say(limit=2e-3))
            assert (after["feed"], after["inputs"]) == (before["feed"], before["inputs"])
            await second.say(take=True)
            await second.hear(lambda: second.role["drives"])
            await first.hear(lambda: not first.role["drives"])
            await second.heard(await second.say(hold=[SPEED, 0.0]))
            await first.line.send("x" * 10_000)  # longer than any message: it is shown the door
            await second.say(end=True)
            await second.hear(lambda: second.report)

    asyncio.run(drive())
    assert served.end().status == "complete"


def test_only_its_own_page_is_let_in(tmp_path: Path) -> None:
    from websockets.exceptions import InvalidStatus

    served = Served(tmp_path, simulation())

    def status(path: str, **headers: str) -> int:
        request = urllib.request.Request(f"http://{served.host}{path}", headers=headers)
        try:
            with urllib.request.urlopen(request, timeout=WAIT) as answer:
                return int(answer.status)
        except urllib.error.HTTPError as refused:
            return refused.code

    assert status("/") == 200
    assert status("/etc/passwd") == 404
    assert status("/", Host="evil.example:80") == 403  # a foreign name that leads here

    async def drive() -> None:
        for origin in ("http://evil.example", "null", "http://127.0.0.1:1"):
            with pytest.raises(InvalidStatus, match="403"):
                async with connect(served, origin):
                    pass
        async with connect(served) as line:
            await Hand(line).say(end=True)

    asyncio.run(drive())
    served.end()
    doors = Doors("0.0.0.0", "secret")
    there = {"Host": "robot:8140", "Origin": "http://robot:8140"}
    assert doors.refuse("/live?token=secret", there) is None
    for path in ("/live", "/", "/?token=secreT", "/?token=%C3%A9"):
        refusal = doors.refuse(path, there)
        assert refusal is not None
        assert refusal.status == 403


def test_others_need_the_token(tmp_path: Path) -> None:
    served = Served(tmp_path, simulation(), host="0.0.0.0")
    assert re.fullmatch(r"http://0\.0\.0\.0:\d+/\?token=[\w-]{20,}", served.address)
    with pytest.raises(urllib.error.HTTPError):
        urllib.request.urlopen(f"http://{served.host}/", timeout=WAIT)
    with urllib.request.urlopen(served.address, timeout=WAIT) as answer:
        assert b"magwire" in answer.read()

    async def drive() -> None:
        async with connect(served) as line:
            await Hand(line).say(end=True)

    asyncio.run(drive())
    served.end()


class Straight:
    """A navigator to one outlet, with a field that tells which."""

    def __init__(self, simulation: mw.Simulation) -> None:
        self.target = simulation.system.lumen.target
        self.strength = 1e-3 if self.target == "ahead" else 2e-3

    def plan(self, observation: Any, until: float) -> mw.Schedule:
        if self.target == "aside" and observation.feed > 2e-3:
            raise NavigationError("The junction is behind.")
        return mw.Schedule(np.array([0.0, 0.1]), np.full((2, 3), [self.strength, 0.0, 0.0]))


def test_the_navigator_leads_to_the_target_that_is_clicked(tmp_path: Path) -> None:
    served = Served(tmp_path, simulation(tree=True), steering=Straight)

    async def drive() -> None:
        async with connect(served) as line:
            hand = Hand(line)
            await hand.hear(lambda: hand.pictures)
            assert hand.world["target"] == "ahead"
            assert list(hand.world["ways"]) == ["ahead", "aside"]
            await hand.say(help="assist")

            async def feed(until: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
                while True:
                    seen = await hand.heard(await hand.say(hold=[SPEED, 0.0]))
                    if until(seen):
                        return seen
                    await asyncio.sleep(0.05)

            seen = await feed(lambda seen: seen["feed"] > 1e-3)
            assert seen["inputs"] == [1e-3, 0.0, 0.0]
            await hand.say(target="aside")
            seen = await feed(lambda seen: seen["inputs"][0] == 2e-3)
            assert seen["target"] == "aside"
            seen = await feed(lambda seen: "junction" in seen["message"])
            # It is the person's turn: back, where it was.
            seen = await hand.heard(await hand.say(rewind=100.0))
            assert seen["feed"] == 0.0
            await hand.say(end=True)
            await hand.hear(lambda: hand.report)

    asyncio.run(drive())
    served.end()


def test_coils_are_driven_by_their_currents(tmp_path: Path) -> None:
    pairs = tuple(Pair(axis, radius=0.15, turns=300, max_current=40.0) for axis in "xyz")
    plain = simulation().system
    coils = mw.Simulation(plain.wire, plain.lumen, actuator=Helmholtz(pairs=pairs))
    served = Served(tmp_path, coils)

    async def drive() -> None:
        async with connect(served) as line:
            hand = Hand(line)
            await hand.hear(lambda: hand.pictures)
            assert not hand.world["uniform"]
            assert [(one["unit"], one["high"]) for one in hand.world["inputs"]] == [("A", 40.0)] * 3
            await hand.say(field=[0.0, 10.0, 0.0])
            await hand.hear(lambda: hand.pictures[-1]["inputs"] == [0.0, 10.0, 0.0])
            # B at the centre of a Helmholtz pair: (4/5)^(3/2) mu0 n I / R.
            centre = 0.8**1.5 * 4e-7 * np.pi * 300 * 10.0 / 0.15
            assert hand.pictures[-1]["field"][1] == pytest.approx(centre, rel=1e-3)
            await hand.say(field=[0.0, 41.0, 0.0])
            await hand.hear(lambda: hand.said)
            assert "between -40 and 40 A; received 41 A" in hand.said[0]
            await hand.say(help="assist")
            seen = hand.pictures[-1]
            while seen["feed"] < 2e-3:  # the navigator's field is found in amperes
                seen = await hand.heard(await hand.say(hold=[SPEED, 0.0]))
                await asyncio.sleep(0.05)
            assert np.abs(seen["inputs"]).max() < 10.0
            await hand.say(end=True)
            await hand.hear(lambda: hand.report)

    asyncio.run(drive())
    served.end()


def test_an_engine_that_stops_ends_in_order(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    served = Served(tmp_path, simulation())

    async def drive() -> None:
        async with connect(served) as line:
            hand = Hand(line)
            await hand.hear(lambda: hand.pictures)
            await hand.heard(await hand.say(hold=[SPEED, 0.0]))

            def burn(_: Any) -> None:
                raise RuntimeError("it burns")

            monkeypatch.setattr("magwire.drive.pilot.Pilot.tick", burn)
            await hand.say(hold=[SPEED, 0.0])
            await hand.hear(lambda: hand.report)
            assert hand.report["failure"] == "The engine stopped: it burns"

    asyncio.run(drive())
    with pytest.raises(RuntimeError, match="it burns"):
        served.end()
    result = mw.Result.load(served.file)
    assert result.status == "failed"
    assert len(result.time) > 0


def test_ctrl_c_closes_the_recording(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "magwire", "drive", "straight", "--port", "0"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        words = iter(process.stdout.readline, "")
        address = next(line for line in words if line.startswith("open http://127.0.0.1:"))
        assert "token" not in address
        host = address.split("http://")[1].strip().strip("/")

        async def interrupt() -> None:
            from websockets.asyncio.client import connect

            async with connect(f"ws://{host}/live", origin=f"http://{host}", proxy=None) as line:
                hand = Hand(line)
                await hand.heard(await hand.say(hold=[SPEED, 0.0]))
                process.send_signal(signal.SIGINT)
                await hand.hear(lambda: hand.report)  # pages get it, too
                assert float(hand.report["rows"]["path of the tip"].split()[0]) >= 0.0

        asyncio.run(interrupt())
        rest, _ = process.communicate(timeout=WAIT)
    assert process.returncode == 0
    assert "peak wall force" in rest
    folder = tmp_path / "straight-drive"
    assert mw.Result.load(folder).status == "complete"
    assert main(["view", str(folder)]) == 0


def test_without_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "websockets", None)
    monkeypatch.chdir(tmp_path)
    assert main(["drive", "straight"]) == 1
    assert "pip install magwire[drive]" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
    with pytest.raises(DriveError):
        serve(simulation())


# --- in a browser ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """What starts a browser."""
    yield from started()


class Opened:
    """The page of a server, and what went wrong in it."""

    def __init__(self, browser: Any, served: Served) -> None:
        self.faults: list[str] = []
        self.elsewhere: list[str] = []
        self.page = browser.new_page(viewport={"width": 900, "height": 640})
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self._listen(request.url, served.host))
        self.page.goto(served.address)
        self.until("window.magwire && magwire.pictures > 0")

    def _listen(self, address: str, host: str) -> None:
        if host not in address:
            self.elsewhere.append(address)

    def ask(self, expression: str) -> Any:
        return self.page.evaluate(expression)

    def until(self, expression: str) -> None:
        end = time.monotonic() + WAIT
        while not self.ask(f"!!({expression})") and time.monotonic() < end:
            self.page.wait_for_timeout(20)
        assert self.ask(f"!!({expression})"), (expression, self.faults)

    def picture(self, element: str) -> np.ndarray:
        shot = self.page.locator(element).first.screenshot()
        return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), dtype=float)


def test_keys_drive_the_wire_and_it_is_seen(chromium: Any, tmp_path: Path) -> None:
    served = Served(tmp_path, simulation(), limit=1e-3)
    shown = Opened(chromium(), served)
    words = shown.page.locator(".status")
    hint = "Hold ↑ to feed the wire; F has the navigator steer."  # once a busy machine keeps up
    shown.until(f"document.querySelector('.status').textContent === '{hint}'")
    limit = shown.page.locator(".limit")
    for absurd in ("-3", "0", "1e99", ""):
        limit.fill(absurd)
        limit.press("Enter")
        assert "it stays at 1.00 mN" in words.inner_text()
        assert limit.input_value() == "1"
    limit.fill("0.2")
    limit.press("Enter")  # keys drive from here on
    shown.until("magwire.picture.limit === 2e-4")
    before = shown.picture(".scene canvas")
    arm = shown.picture(".arm-frontal canvas")
    assert len(np.unique(before.reshape(-1, 3), axis=0)) > 50
    assert len(np.unique(arm.reshape(-1, 3), axis=0)) > 50
    shown.ask("magwire.cockpit.setSpeed(0.03)")
    shown.page.keyboard.down("ArrowUp")
    shown.until("magwire.picture.message.includes('limit')")  # the wall stops the advance
    stopped = shown.ask("magwire.picture")
    assert stopped["wallForce"] >= stopped["limit"] == 2e-4
    shown.until("magwire.gauge.level == 'red'")
    shown.page.keyboard.up("ArrowUp")
    assert np.abs(shown.picture(".scene canvas") - before).max() > 100.0
    shown.page.keyboard.down("s")  # back is allowed
    shown.until(f"magwire.picture.feed < {stopped['feed']} - 1e-3")
    shown.page.keyboard.up("s")
    shown.until("magwire.picture.rate == 0 || magwire.picture.message == ''")
    # The gauge is the engine's force of the same step, and the picture its wire.
    same = shown.ask(
        "(magwire.cockpit.show(), {force: magwire.gauge.force, wall: magwire.picture.wallForce,"
        " points: magwire.points(), forces: magwire.forces()})"
    )
    assert same["force"] == same["wall"]
    forces = np.reshape(same["forces"], (-1, 3))
    assert np.linalg.norm(forces, axis=1).sum() == pytest.approx(same["wall"], rel=1e-5, abs=1e-12)
    # A button that is held, the field by keys, another speed.
    there = shown.ask("magwire.picture.feed")
    box = shown.page.locator("[data-hold=advance]").bounding_box()
    shown.page.mouse.move(box["x"] + 5, box["y"] + 5)
    shown.page.mouse.down()
    shown.until(f"magwire.picture.feed > {there}")
    shown.page.mouse.up()
    # A gamepad's left stick, pulled back; one that is let go does not quite come back to zero.
    pad = "navigator.getGamepads = () => [{connected: true, buttons: [], axes: [0.05, %s, 0, 0]}]"
    there = shown.ask("magwire.picture.feed")
    shown.ask(f"({pad % '0.9'}, 0)")
    shown.until(f"magwire.picture.feed < {there}")
    shown.ask(f"({pad % '0.1'}, 0)")
    shown.until("magwire.cockpit.last.feed === 0")
    shown.page.keyboard.down("o")
    shown.until("Math.hypot(...magwire.picture.inputs) > 1e-3")
    shown.page.keyboard.up("o")
    pad = shown.page.locator(".field canvas").bounding_box()
    shown.page.mouse.click(pad["x"] + pad["width"] / 2, pad["y"] + 12)  # upwards on the screen
    shown.until(
        "(() => { const {right, up} = magwire.cockpit.camera.axes(), b = magwire.picture.inputs;"
        " const along = (a) => a[0]*b[0] + a[1]*b[1] + a[2]*b[2];"
        " return along(up) > 5 * Math.abs(along(right)) && along(up) > 0; })()"
    )
    assert shown.ask("magwire.latencies.length") >= 2
    shown.page.click(".end")
    shown.until("magwire.cockpit.done")
    assert "retractions" in shown.page.locator(".report").inner_text()
    assert not shown.faults
    assert not shown.elsewhere
    shown.page.close()
    result = served.end()
    assert served.outcome is not None
    assert served.outcome.account.retractions == 2
    recorded = result.dataset["wall_force"].values
    assert served.outcome.account.peak_force >= recorded.max() > 0.0


def test_a_slow_painter_gives_way(chromium: Any, tmp_path: Path) -> None:
    """Strokes without a graphics processor; shaded pictures that are asked for go by their pace."""
    served = Served(tmp_path, simulation())
    shown = Opened(chromium(), served)

    def painted(way: int, mode: str) -> None:
        assert shown.ask("[magwire.cockpit.scene.way, magwire.mode]") == [way, mode]
        shown.page.wait_for_timeout(100)
        picture = shown.picture(".scene canvas")
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50
        assert shown.ask("document.querySelectorAll('.scene canvas').length") == 1

    shown.until("magwire.picture.rate === 0 && !magwire.cockpit.fresh")
    shown.ask("(magwire.cockpit.pace.spans = [], 0)")  # of pictures so far, quick or slow
    painted(2, "canvas")
    words = shown.page.locator(".way")
    assert words.inner_text() == "plain strokes"
    shown.page.click(".way")
    painted(0, "webgl2")
    assert words.is_hidden()
    shown.ask("magwire.cockpit.scene.repaint(1)")
    painted(1, "webgl2")
    shown.ask("[...Array(23)].forEach(() => magwire.cockpit.pace.took(16))")
    shown.ask("[...Array(12)].forEach(() => magwire.cockpit.pace.took(300))")
    assert shown.ask("magwire.mode") == "webgl2"  # some slow ones are none of its business
    shown.ask("[...Array(36)].forEach(() => magwire.cockpit.pace.took(60))")
    painted(2, "canvas")
    assert words.inner_text() == "plain strokes"
    shown.page.click(".end")
    shown.until("magwire.cockpit.done")
    assert not shown.faults
    shown.page.close()
    served.end()


def test_roadmaps_stay_where_they_were_taken(chromium: Any, tmp_path: Path) -> None:
    """A wall that moves does so in 3D; the C-arms' overlay is that of the wall at rest, as said.

    The page is told of a wall that moves; the engine's rests, which needs no other kernels.
    """
    served = Served(tmp_path, simulation())
    shown = Opened(chromium(), served)
    arms = shown.page.locator(".arm > span")
    assert arms.all_inner_texts() == ["frontal", "lateral"]
    told = json.dumps(motions(BREATHING))
    shown.ask(
        f"(() => {{ const {{ cockpit }} = magwire, world = {{ ...cockpit.world, motions: {told} }};"
        " cockpit.scene.setWorld({ ...world, path: [] });"
        " cockpit.arms.forEach((arm) => arm.setWorld(world)); })()"
    )
    assert arms.all_inner_texts() == [f"{name}, roadmap at rest" for name in ("frontal", "lateral")]
    overlay = "magwire.cockpit.arms.map((arm) => arm.still.toDataURL())"
    wall = "[...magwire.cockpit.scene.mesh.positions]"
    roadmaps, rest = shown.ask(overlay), shown.ask("magwire.cockpit.scene.moving.corners")
    shown.page.keyboard.down("w")
    shown.until("magwire.picture.time > 1.0")
    shown.page.keyboard.up("w")
    at_once = f"(magwire.cockpit.show(), [magwire.picture.time, {wall}])"  # of the same picture
    then, corners = shown.ask(at_once)
    moved = gone(BREATHING, np.asarray(rest), np.zeros(3), then)
    np.testing.assert_allclose(np.reshape(corners, (-1, 3)), moved, atol=1e-6)
    assert np.abs(moved - rest).max() > 1e-4
    assert shown.ask(overlay) == roadmaps
    shown.page.click(".end")
    shown.until("magwire.cockpit.done")
    assert not shown.faults
    shown.page.close()
    served.end()


def test_rewind_reload_and_two_tabs(chromium: Any, tmp_path: Path) -> None:
    served = Served(tmp_path, simulation())
    shown = Opened(chromium(), served)
    shown.ask("magwire.cockpit.setSpeed(0.02)")
    shown.page.keyboard.down("w")
    shown.until("magwire.picture.time > 1.5")
    shown.page.keyboard.up("w")
    there = shown.ask("magwire.picture.time")
    shown.page.click("[data-rewind='2']")
    shown.until(f"magwire.picture.time < {there}")
    assert shown.ask("magwire.picture.feed") == 0.0
    other = Opened(chromium(), served)
    assert other.ask("magwire.role") == {"drives": False, "free": False}
    assert "looks on" in other.page.locator(".status").inner_text()
    other.page.click(".take")
    other.until("magwire.role.drives")
    shown.until("!magwire.role.drives")
    other.page.close()
    shown.until("magwire.role.free")
    shown.page.reload()
    shown.until("window.magwire && magwire.pictures > 0 && magwire.role.drives")
    # A connection that breaks with a key held stops the wire, says so and comes back.
    shown.page.keyboard.down("w")
    shown.until("magwire.picture.feed > 0")
    shown.ask("magwire.cockpit.live.socket.close()")
    shown.until("document.querySelector('.status').textContent.includes('lost')")
    shown.page.keyboard.up("w")
    shown.until("magwire.cockpit.connected && magwire.role.drives")
    shown.page.click(".end")
    shown.until("magwire.cockpit.done")
    assert not shown.faults
    shown.page.close()
    result = served.end()
    assert np.all(np.diff(result.time) > 0.0)

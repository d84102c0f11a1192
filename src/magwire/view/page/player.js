// Replays one run, or two side by side: time, controls, and what tests may ask.
"use strict";
((parts) => {
  const { nearest, unpackRun } = parts.data;
  const PLAY = 14; // seconds that a replay takes at first, about
  const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
  const SAMPLES = 60; // records that are looked at for the largest pressure

  const make = (kind, className, text = "") => {
    const element = document.createElement(kind);
    element.className = className;
    element.textContent = text;
    return element;
  };

  // What is drawn over time: title, unit, factor from SI, and its curves.
  const PANELS = [
    { title: "Force of the wall", unit: "mN", factor: 1e3, none: "nothing touches the wall", curves: [["tip", "tip_force", "#d55e00"], ["whole wire", "wall_force", "#7c5295"]] },
    { title: "Push at the guide", unit: "mN", factor: 1e3, none: "not known", curves: [["push", "push_force", "#0072b2"]] },
    { title: "Field at the tip", unit: "mT", factor: 1e3, none: "no field", curves: [["x", "field_x", "#0072b2"], ["y", "field_y", "#d55e00"], ["z", "field_z", "#009e73"]] },
    { title: "Clearance to the wall", unit: "mm", factor: 1e3, log: true, none: "no wall", curves: [["tip", "tip_clearance", "#e69f00"], ["smallest", "clearance", "#0072b2"]] },
  ];

  class Player {
    constructor(runs, root) {
      this.runs = runs;
      this.root = root;
      this.time = 0;
      this.camera = new parts.Camera();
      runs.forEach((run) => {
        [0, 1, 2].forEach((i) => {
          run.arrays[`field_${"xyz"[i]}`] = Float64Array.from({ length: run.count }, (_, k) => run.arrays.field[3 * k + i]);
        });
      });
      this.span = [Math.min(...runs.map((run) => run.arrays.time[0])), Math.max(...runs.map((run) => run.arrays.time[run.count - 1]))];
      this.records = runs.map(() => 0);
      this.views = runs.map((run, which) => this.view(run, runs.length > 1 ? `${which + 1}: ` : ""));
      this.scale();
      this.panels = this.curves();
      this.controls();
      this.preset("overview");
      this.seek(this.span[0]);
      addEventListener("resize", () => this.untouched && this.preset(this.untouched));
    }

    view(run, number) {
      const view = make("figure", "view");
      const words = make("figcaption", "words");
      words.append(make("strong", "", number + (run.title || run.name)), make("span", `state ${run.status === "complete" ? "" : "bad"}`, run.facts));
      const readings = make("div", "readings");
      const bar = make("div", "scalebar");
      const axes = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      axes.setAttribute("class", "axes");
      axes.setAttribute("viewBox", "-32 -32 64 64");
      view.append(words, readings, bar, axes);
      this.root.querySelector(".views").append(view);
      const scene = new parts.Scene(view, this.camera);
      const path = [];
      if (!run.branches.length)
        for (let k = 0; k < run.count; k += Math.ceil(run.count / 20)) {
          const points = run.points(k);
          for (let v = 0; v < points.length; v += 3) path.push([points[v], points[v + 1], points[v + 2]]);
        }
      scene.setWorld({ branches: run.branches, wire: run.wire, path, surface: run.surface, motions: run.motions });
      scene.afterwards = () => this.decorate(scene, bar, axes);
      return { run, scene, readings };
    }

    // One scale for both, so that they can be compared.
    scale() {
      const largest = { force: 0, field: 0, pressure: 0 };
      for (const { run, scene } of this.views) {
        const { contact_force: force, field, wall_force: wall } = run.arrays;
        for (let k = 0; k < force.length; k += 3) largest.force = Math.max(largest.force, Math.hypot(force[k], force[k + 1], force[k + 2]));
        for (let k = 0; k < field.length; k += 3) largest.field = Math.max(largest.field, Math.hypot(field[k], field[k + 1], field[k + 2]));
        const every = Math.max(1, Math.floor(run.count / SAMPLES));
        for (let k = run.count - 1; k >= 0; k -= every)
          if (wall[k] > 0) {
            scene.move(run.arrays.time[k]);
            for (const value of scene.pressureOf(run.points(k), run.forces(k))) largest.pressure = Math.max(largest.pressure, value);
          }
      }
      this.views.forEach(({ scene }) => scene.setScales(largest));
      this.largest = largest;
      this.root.querySelector(".heat .top").textContent = `${parts.shortly(Number(largest.pressure.toPrecision(2)))} Pa`;
      this.root.querySelector(".heat").hidden = !(largest.pressure > 0);
      this.root.querySelector(".key .force").hidden = !(largest.force > 0);
      this.root.querySelector(".key .field").hidden = !(largest.field > 0);
      this.root.querySelector(".key .force b").textContent = `${parts.shortly(Number((1e3 * largest.force).toPrecision(3)))} mN`;
      this.root.querySelector(".key .field b").textContent = `${parts.shortly(Number((1e3 * largest.field).toPrecision(3)))} mT`;
    }

    curves() {
      const holder = this.root.querySelector(".curves");
      const times = this.runs.map((run) => run.arrays.time);
      return PANELS.map(({ title, unit, factor, log, none, curves }) => {
        const series = this.runs.flatMap((run, which) =>
          curves.map(([name, key, colour]) => ({
            name: this.runs.length > 1 ? `${which + 1}: ${name}` : name,
            key,
            colour,
            run: which,
            dashed: which > 0,
            values: Float64Array.from(run.arrays[key], (value) => factor * value),
          })),
        );
        return new parts.Panel(holder, { title, unit, log, none, series, times, span: this.span }, (time) => this.seek(time));
      });
    }

    controls() {
      const find = (name) => this.root.querySelector(name);
      const whole = this.span[1] - this.span[0];
      [this.button, this.slider, this.clock] = [".play", ".scrub", ".clock"].map(find);
      const speed = find(".speed");
      for (const value of SPEEDS) speed.append(new Option(`${value}×`, value));
      this.speed = SPEEDS.reduce((best, value) => (Math.abs(Math.log((value * PLAY) / whole)) < Math.abs(Math.log((best * PLAY) / whole)) ? value : best));
      speed.value = this.speed;
      speed.addEventListener("change", () => (this.speed = Number(speed.value)));
      [this.slider.min, this.slider.max, this.slider.step] = [...this.span, "any"];
      this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
      this.button.addEventListener("click", () => this.toggle());
      const presets = [...this.root.querySelectorAll("[data-preset]")];
      for (const button of presets) button.addEventListener("click", () => this.preset(button.dataset.preset));
      this.views.forEach(({ scene }) => scene.holder.addEventListener("pointerdown", () => (this.untouched = "")));
      this.views.forEach(({ scene }) => scene.holder.addEventListener("dblclick", () => this.preset("overview")));
      addEventListener("keydown", (event) => {
        if (["SELECT", "BUTTON"].includes(event.target.tagName) && event.key === " ") return;
        const by = { ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10 }[event.key];
        if (event.key === " ") this.toggle();
        else if (by) this.step(by * (event.shiftKey ? 10 : 1));
        else if (event.key === "Home") this.seek(this.span[0]);
        else if (event.key === "End") this.seek(this.span[1]);
        else if (event.key >= "1" && event.key <= "5") this.preset(presets[event.key - 1].dataset.preset);
        else return;
        event.preventDefault();
      });
    }

    preset(name) {
      this.untouched = name;
      parts.preset(this.views.map(({ scene }) => scene), name);
      for (const button of this.root.querySelectorAll("[data-preset]")) button.classList.toggle("on", button.dataset.preset === name);
    }

    toggle() {
      this.playing = !this.playing;
      this.button.classList.toggle("on", this.playing);
      this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
      if (!this.playing) return;
      if (this.time >= this.span[1]) this.time = this.span[0];
      let before = performance.now();
      const turn = (now) => {
        if (!this.playing) return;
        this.seek(Math.min(this.span[1], this.time + (this.speed * Math.max(0, now - before)) / 1e3));
        before = now;
        if (this.time >= this.span[1]) this.toggle();
        else requestAnimationFrame(turn);
      };
      requestAnimationFrame(turn);
    }

    step(by) {
      const { time } = this.runs[0].arrays;
      this.seek(time[Math.max(0, Math.min(time.length - 1, this.records[0] + by))]);
    }

    // Show the records that are nearest to a time [s].
    seek(time) {
      this.time = Math.max(this.span[0], Math.min(this.span[1], time));
      this.records = this.runs.map((run) => nearest(run.arrays.time, this.time));
      this.views.forEach(({ run, scene, readings }, which) => {
        const k = this.records[which];
        scene.show({ points: run.points(k), forces: run.forces(k), field: run.field(k), time: run.arrays.time[k] });
        const [fed, strength] = [1e3 * run.arrays.feed[k], 1e3 * Math.hypot(...run.field(k))];
        readings.textContent = `inserted ${fed.toFixed(1)} mm   field ${strength.toFixed(1)} mT${run.arrays.stable[k] > 0 ? "" : "   unstable"}`;
      });
      this.panels.forEach((panel) => panel.show(this.records));
      this.slider.value = this.time;
      this.slider.style.setProperty("--done", `${(100 * (this.time - this.span[0])) / (this.span[1] - this.span[0] || 1)}%`);
      this.clock.textContent = `${this.time.toFixed(1)} s of ${this.span[1].toFixed(1)} s`;
      this.pictures = (this.pictures ?? 0) + 1;
    }

    // A scale bar and the axes, for the camera as it is.
    decorate(scene, bar, axes) {
      const pixels = this.camera.pixels(scene.holder.clientHeight);
      const raw = 110 / pixels;
      const power = 10 ** Math.floor(Math.log10(raw));
      const length = [5, 2, 1].map((k) => k * power).find((k) => k <= raw) ?? power;
      bar.style.width = `${length * pixels}px`;
      bar.textContent = `${Number((1e3 * length).toPrecision(3))} mm`;
      const { right, up, back } = this.camera.axes();
      axes.innerHTML = [0, 1, 2]
        .sort((i, j) => back[i] - back[j])
        .map((i) => {
          const [x, y, far] = [22 * right[i], -22 * up[i], Math.hypot(right[i], up[i]) < 0.2];
          const colour = parts.colours.components[i];
          const letter = far ? "" : `<text x="${1.32 * x}" y="${1.32 * y + 3.5}" fill="${colour}">${"xyz"[i]}</text>`;
          return `<line x2="${x}" y2="${y}" stroke="${colour}"/>${letter}`;
        })
        .join("");
    }
  }

  // What tests and the curious may ask, in SI units; run 0 is the first result, run 1 the second.
  function answers(player) {
    return {
      runs: player.runs.length,
      get mode() {
        return player.views[0].scene.mode;
      },
      seek: (time) => player.seek(time),
      times: (run = 0) => [...player.runs[run].arrays.time],
      record: (run = 0) => player.records[run],
      points: (run = 0) => [...player.views[run].scene.state.points],
      forces: (run = 0) => [...player.views[run].scene.state.forces],
      wall: (run = 0) => [...player.views[run].scene.mesh.positions],
      pressed: (run = 0) => {
        const { scene } = player.views[run];
        const pressure = scene.pressureOf(scene.state.points, scene.state.forces);
        return pressure.reduce((sum, value, v) => sum + value * scene.mesh.areas[v], 0);
      },
      values: (run = 0) => {
        const { arrays } = player.runs[run];
        const k = player.records[run];
        const plain = Object.entries(arrays).filter(([, values]) => values.length === arrays.time.length);
        return Object.fromEntries(plain.map(([name, values]) => [name, values[k]]));
      },
      // Each curve's mark: what is written next to it, and the value of the height that it is drawn at.
      marks: () =>
        player.panels.flatMap((panel) =>
          panel.markers.map((mark, k) => ({
            key: panel.series[k].key,
            run: mark.run,
            unit: panel.unit,
            written: panel.readings[k].textContent,
            drawn: panel.valueAt(mark.y),
            panel: player.panels.indexOf(panel),
            x: mark.x,
            y: mark.y,
          })),
        ),
      toggle: () => player.toggle(),
      preset: (name) => player.preset(name),
      pictures: () => player.pictures,
    };
  }

  async function begin() {
    const root = document.querySelector(".page");
    try {
      const given = JSON.parse(document.getElementById("data").textContent);
      const player = new Player(await Promise.all(given.runs.map(unpackRun)), root);
      window.magwire = answers(player);
    } catch (error) {
      root.querySelector(".views").textContent = `This page needs a browser of 2023 or later (${error.message}).`;
      throw error;
    }
  }

  parts.begin = begin;
})((window.magwireParts ??= {}));

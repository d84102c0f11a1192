// The picture of a wire in its lumen. It knows nothing of records or of time: it is handed arrays,
// from a file that is replayed or from a run that is going on.
"use strict";
((parts) => {
  const { add, sub, scale, dot, norm, unit, at, principal } = parts.algebra;
  const SPREAD = 0.8; // radius of the disc that a node's force presses on, over that of the lumen
  const FIELD_ARROW = 0.2; // length of the arrow of the largest field, over the size of the picture
  const CLOSE = 18; // distance to the tip, over the radius of the lumen
  const CLOSE_ARROW = 4; // the same over the radius of the lumen, where the camera follows the tip
  const FORCE_ARROW = 2.4; // that of the largest force, over the radius of the lumen
  const GUIDE = 0.22; // length of the guide that is seen before the entrance, over the size
  const LEAST = 2e-3; // of the largest force: smaller ones have no arrow
  // Ways to paint, each quicker than the one before it; finest: pixels of the canvas over those of the page, at most.
  const WAYS = [
    { made: (canvas, quick) => new parts.WebglPainter(canvas, { quick }), finest: 2 },
    { made: (canvas, quick) => new parts.WebglPainter(canvas, { quick, antialias: false }), finest: 1 },
    { made: (canvas) => new parts.FlatPainter(canvas), finest: 1.5 },
  ];

  class Scene {
    // holder: the element that is filled; camera: may be shared with other scenes; quick: whether plain strokes
    // are better than shaded pictures without a graphics processor.
    constructor(holder, camera, quick = false) {
      this.holder = holder;
      this.camera = camera;
      this.follow = false; // whether the tip stays in the middle
      this.shift = [0, 0, 0]; // from the camera's target to this scene's: scenes may share a camera
      this.start(0, quick);
      camera.watchers.push(() => this.draw());
      new ResizeObserver(() => this.resize()).observe(holder);
    }

    start(way, quick) {
      const canvas = document.createElement("canvas");
      try {
        this.painter = WAYS[way].made(canvas, quick);
      } catch {
        this.start(WAYS.length - 1, quick);
        return;
      }
      this.canvas?.remove();
      [this.canvas, this.way] = [canvas, way];
      this.holder.prepend(canvas);
      this.camera.attach(canvas);
      canvas.addEventListener("webglcontextlost", () => canvas === this.canvas && this.repaint(WAYS.length - 1));
    }

    // Go on in another way, with the next picture there before the last one is gone.
    repaint(way, quick = false) {
      this.start(way, quick);
      this.painter.setWall(this.mesh);
      this.resize();
      this.refresh();
    }

    // Go on in a quicker way; whether there is one.
    hurry() {
      if (this.way + 1 === WAYS.length) return false;
      this.repaint(this.way + 1, true);
      return true;
    }

    get mode() {
      return this.painter.mode;
    }

    // branches: [{points: [[x, y, z], ...], radii}]; wire: {radius, onAxis, magnet: [flags]}, where onAxis
    // says that the wall holds the wire's centreline; path: all there is to see in open space [m]; surface:
    // the wall's corners, triangles and rings, where it is not of balls; motions: of the wall, if it moves.
    setWorld({ branches, wire, path, surface, motions = [] }) {
      this.wire = wire;
      this.branches = branches;
      this.mesh = surface ? parts.geometry.surface(surface) : parts.geometry.wall(branches);
      this.painter.setWall(this.mesh);
      const points = branches.length ? branches.flatMap((branch) => branch.points) : path;
      const radii = branches.length ? branches.flatMap((branch) => branch.radii) : path.map(() => wire.radius);
      const sorted = [...radii].sort((a, b) => a - b);
      this.lumenRadius = branches.length ? sorted[Math.floor(sorted.length / 2)] : 5 * wire.radius;
      this.bounds = { points, radii };
      const low = [0, 1, 2].map((k) => Math.min(...points.map((point, i) => point[k] - radii[i])));
      const high = [0, 1, 2].map((k) => Math.max(...points.map((point, i) => point[k] + radii[i])));
      this.size = norm(sub(high, low));
      this.entrance = points[0];
      if (motions.length) this.moving = new parts.geometry.Moving(this.mesh, motions, this.entrance);
      this.inwards = unit(sub(points[Math.min(1, points.length - 1)], points[0]));
    }

    // What is drawn largest: force on a node [N], flux density [T], pressure of the wall [Pa].
    setScales({ force, field, pressure }) {
      this.scales = { force, field, pressure };
    }

    // Have the wall be where it is at a time.
    move(time) {
      if (!this.moving) return;
      this.moving.to(time);
      this.painter.moveWall(this.mesh);
    }

    pressureOf(points, forces) {
      const skin = this.wire.onAxis ? 0 : this.wire.radius;
      return parts.geometry.pressure(this.mesh, points, forces, { skin, spread: SPREAD });
    }

    // points, forces: flat arrays of three for each node [m, N]; field: [x, y, z] at the tip [T]; suggested:
    // what it should be, if anybody says; time [s].
    show({ points, forces, field, time, suggested = null }) {
      this.move(time);
      this.state = { points, forces, field, suggested };
      this.refresh();
    }

    refresh() {
      if (!this.state) return;
      const { points, forces, field, suggested } = this.state;
      const heat = this.pressureOf(points, forces);
      const top = this.scales.pressure;
      this.painter.setMoving({
        heat: heat.map((value) => (top > 0 ? value / top : 0)),
        tubes: this.tubes(points),
        arrows: [...this.forceArrows(points, forces), ...this.fieldArrow(points, field), ...this.fieldArrow(points, suggested ?? [0, 0, 0], "suggested")],
      });
      if (this.follow) this.shift = sub(at(points, points.length / 3 - 1), this.camera.target);
      this.draw();
    }

    // A wire whose centreline the wall holds is drawn slim, or it would stick out.
    get drawnRadius() {
      return this.wire.onAxis ? 0.45 * this.wire.radius : this.wire.radius;
    }

    tubes(points) {
      const nodes = Array.from({ length: points.length / 3 }, (_, k) => at(points, k));
      const reach = GUIDE * this.size;
      const behind = (node) => -dot(sub(node, this.entrance), this.inwards);
      const mouth = nodes.findIndex((node) => behind(node) <= 0); // from there on it is in the lumen
      const fade = (k) => (mouth >= 0 && k >= mouth ? 1 : Math.max(0, 1 - Math.max(0, behind(nodes[k])) / reach));
      const begin = Math.max(0, nodes.findIndex((_, k) => fade(k) > 0));
      const r = this.drawnRadius;
      const made = [];
      for (let begins = begin; begins < nodes.length - 1; ) {
        const k = begins;
        const magnetic = this.wire.magnet[k] && this.wire.magnet[k + 1];
        let end = k + 1;
        while (end < nodes.length - 1 && Boolean(this.wire.magnet[end] && this.wire.magnet[end + 1]) === Boolean(magnetic)) end++;
        const run = nodes.slice(k, end + 1);
        const colour = magnetic ? parts.colours.magnet : parts.colours.wire;
        made.push({
          points: run,
          radii: run.map(() => (magnetic ? 1.12 * r : r)),
          colours: run.map((_, i) => [...colour, fade(k + i)]),
        });
        begins = end;
      }
      return made;
    }

    forceArrows(points, forces) {
      const longest = FORCE_ARROW * this.lumenRadius;
      const found = [];
      for (let k = 0; k < points.length / 3; k++) {
        const force = at(forces, k);
        const share = norm(force) / this.scales.force;
        if (!(share > LEAST)) continue;
        const radius = Math.min(0.5 * this.drawnRadius, 0.08 * this.lumenRadius);
        found.push({ from: at(points, k), by: scale(unit(force), share * longest), radius, colour: [...parts.colours.force, 1] });
      }
      return found;
    }

    fieldArrow(points, field, colour = "field") {
      const share = norm(field) / this.scales.field;
      if (!(share > 0.01)) return [];
      const tip = at(points, points.length / 3 - 1);
      const longest = this.follow ? CLOSE_ARROW * this.lumenRadius : FIELD_ARROW * this.size;
      const by = scale(field, longest / this.scales.field);
      return [{ from: tip, by, radius: 0.0275 * longest, colour: [...parts.colours[colour], 1] }];
    }

    // Where the camera has to be to see all of the lumen, from the direction that it looks in.
    framing() {
      const aspect = (this.holder.clientWidth || 1) / (this.holder.clientHeight || 1);
      const arrow = this.scales.field > 0 ? 0.04 * this.size : 0;
      const every = Math.ceil(this.bounds.points.length / 400);
      const some = (list) => list.filter((_, k) => k % every === 0 || k === list.length - 1);
      const guide = sub(this.entrance, scale(this.inwards, 0.3 * GUIDE * this.size));
      this.camera.fit([...some(this.bounds.points), guide], [...some(this.bounds.radii).map((r) => r + arrow), arrow], aspect);
      return { target: this.camera.target, distance: this.camera.distance };
    }

    // Onto the lumen's broad side, at a slant, so that depth can be seen.
    bestView() {
      const [first, second, last] = principal(this.bounds.points);
      const down = last.direction[2] < -1e-6 || (Math.abs(last.direction[2]) < 1e-6 && last.direction[1] > 0);
      const direction = scale(last.direction, down ? -1 : 1);
      if (last.extent < 1e-3 * first.extent) return add(direction, scale(Math.abs(direction[2]) > 0.9 ? [0, -1, 0] : [0, 0, 1], 0.3));
      const solid = Math.min(1, (2 * last.extent) / first.extent); // 0: flat, 1: as thick as half its length
      const aside = scale(second.direction, second.direction[1] > 0 ? -solid : solid);
      return add(add(direction, aside), [0, 0, 0.4 * (1 - Math.abs(direction[2]))]);
    }

    resize() {
      const ratio = Math.min(window.devicePixelRatio || 1, WAYS[this.way].finest);
      const [width, height] = [this.holder.clientWidth, this.holder.clientHeight].map((x) => Math.max(1, Math.round(x * ratio)));
      if (this.canvas.width !== width || this.canvas.height !== height) {
        this.canvas.width = width;
        this.canvas.height = height;
      }
      this.draw();
    }

    draw() {
      if (!this.mesh || !this.state) return;
      const camera = Object.assign(new parts.Camera(), this.camera);
      camera.target = add(camera.target, this.shift);
      this.painter.paint(camera, 2 * this.size);
      this.afterwards?.();
    }
  }

  // Show scenes that share a camera from "overview", "x", "y" or "z", or the "tip" close by.
  function preset(scenes, name) {
    const [{ camera, lumenRadius }] = scenes;
    if (name !== "tip") camera.look(name === "overview" ? scenes[0].bestView() : [0, 1, 2].map((k) => +("xyz"[k] === name)));
    const framings = scenes.map((scene) => scene.framing());
    camera.target = framings[0].target;
    camera.distance = Math.max(...framings.map(({ distance }) => distance));
    if (name === "tip") camera.distance = Math.min(camera.distance, CLOSE * lumenRadius);
    scenes.forEach((scene, k) => {
      scene.follow = name === "tip";
      scene.shift = sub(framings[k].target, camera.target);
      scene.refresh();
    });
    camera.changed();
  }

  parts.Scene = Scene;
  parts.preset = preset;
})((window.magwireParts ??= {}));

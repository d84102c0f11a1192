// What a C-arm shows: the wire's shadow, noise, and the vessel as a roadmap laid over it.
"use strict";
((parts) => {
  const { add, scale, sub, unit, cross, dot } = parts.algebra;
  const BY_PROCESSOR = { willReadFrequently: true }; // small pictures, and there may be no other one
  const GRAIN = 160; // pixels of a tile of noise
  const TILES = 5;
  const LEVELS = [174, 180, 184]; // of what shadows nothing: grey, a little cold
  const ROADMAP = "rgba(96, 226, 196, 0.85)";
  const ROUTE = "rgba(255, 214, 92, 0.9)";

  // Tiles of grain, the same every time.
  function grain() {
    let seed = 20260101;
    const chance = () => {
      seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
      return seed / 2 ** 32;
    };
    return Array.from({ length: TILES }, () => {
      const tile = document.createElement("canvas");
      tile.width = tile.height = GRAIN;
      const pen = tile.getContext("2d", BY_PROCESSOR);
      const image = pen.createImageData(GRAIN, GRAIN);
      for (let k = 0; k < image.data.length; k += 4) {
        const dark = chance() < 0.5;
        image.data[k] = image.data[k + 1] = image.data[k + 2] = dark ? 0 : 255;
        image.data[k + 3] = 26 * (chance() + chance());
      }
      pen.putImageData(image, 0, 0);
      return tile;
    });
  }

  class Fluoroscopy {
    // direction: from the patient to the detector; name: of the projection.
    constructor(holder, name, direction) {
      this.holder = holder;
      this.canvas = document.createElement("canvas");
      this.label = document.createElement("span");
      this.label.textContent = name;
      holder.append(this.canvas, this.label);
      this.still = document.createElement("canvas");
      this.camera = new parts.Camera();
      this.camera.look(direction);
      this.tiles = grain();
      this.count = 0;
      new ResizeObserver(() => this.resize()).observe(holder);
    }

    // As for a scene; ways: the course to each outlet. A roadmap was taken once: the wall may move away from it.
    setWorld({ branches, surface, wire, ways, target, motions }) {
      Object.assign(this, { branches, surface, wire, ways, target });
      if (motions.length) this.label.textContent += ", roadmap at rest";
      this.lumenRadius = Math.min(...branches.flatMap(({ radii }) => radii), Infinity);
      this.resize();
    }

    aim(target) {
      this.target = target;
      this.paintStill();
      this.paint();
    }

    resize() {
      if (!this.wire) return;
      const ratio = Math.min(window.devicePixelRatio || 1, 1.5);
      const [width, height] = [this.holder.clientWidth, this.holder.clientHeight].map((x) => Math.max(1, Math.round(x * ratio)));
      for (const canvas of [this.canvas, this.still]) [canvas.width, canvas.height] = [width, height];
      const points = this.branches.flatMap((branch) => branch.points);
      if (points.length) {
        const radii = this.branches.flatMap((branch) => branch.radii).map((r) => 1.8 * r);
        this.camera.fit(points, radii, width / height);
      }
      this.paintStill();
      this.paint();
    }

    show({ points }) {
      this.points = points;
      this.paint();
    }

    // The empty field of view with the roadmap.
    paintStill() {
      const { width, height } = this.still;
      const pen = this.still.getContext("2d", BY_PROCESSOR);
      const [r, g, b] = LEVELS;
      const field = pen.createRadialGradient(width / 2, height / 2, 0.1 * height, width / 2, height / 2, 0.75 * Math.hypot(width, height) / 1.2);
      field.addColorStop(0, `rgb(${r},${g},${b})`);
      field.addColorStop(1, `rgb(${0.45 * r},${0.45 * g},${0.46 * b})`);
      pen.fillStyle = field;
      pen.fillRect(0, 0, width, height);
      this.project = this.camera.projector(width, height);
      pen.drawImage(this.outline(), 0, 0);
      this.paintRoute(pen);
    }

    // The rim of all branches together: their shadow less the same a little slimmer; or that of the triangles.
    outline() {
      const layer = document.createElement("canvas");
      [layer.width, layer.height] = [this.still.width, this.still.height];
      const pen = layer.getContext("2d", BY_PROCESSOR);
      if (this.surface) {
        pen.strokeStyle = ROADMAP;
        parts.outline(pen, this.surface, this.project, 2.6, () => (pen.globalCompositeOperation = "destination-out"));
        return layer;
      }
      pen.lineCap = "butt";
      for (const [operation, colour, less] of [["source-over", ROADMAP, 0], ["destination-out", "#000", 2.6]]) {
        pen.globalCompositeOperation = operation;
        pen.strokeStyle = pen.fillStyle = colour;
        for (const { points, radii } of this.branches)
          points.forEach((point, k) => {
            const [x, y, , there] = this.project(...point);
            const radius = Math.max(0.5, radii[k] * there - less);
            if (k && k + 1 < points.length) {
              pen.beginPath();
              pen.arc(x, y, radius, 0, 2 * Math.PI);
              pen.fill();
            }
            if (!k) return;
            const [fromX, fromY] = this.project(...points[k - 1]);
            pen.lineWidth = 2 * radius;
            pen.beginPath();
            pen.moveTo(fromX, fromY);
            pen.lineTo(x, y);
            pen.stroke();
          });
      }
      return layer;
    }

    paintRoute(pen) {
      const way = this.ways[this.target] ?? Object.values(this.ways)[0];
      if (!way) return;
      pen.strokeStyle = pen.fillStyle = ROUTE;
      pen.lineWidth = 1.2;
      pen.setLineDash([2, 5]);
      pen.beginPath();
      way.forEach((point, k) => {
        const [x, y] = this.project(...point);
        if (k) pen.lineTo(x, y);
        else pen.moveTo(x, y);
      });
      pen.stroke();
      pen.setLineDash([]);
      const [x, y] = this.project(...way.at(-1));
      pen.lineWidth = 1.6;
      pen.beginPath();
      pen.arc(x, y, 6, 0, 2 * Math.PI);
      pen.stroke();
    }

    paint() {
      if (!this.project) return;
      const { width, height } = this.canvas;
      const pen = this.canvas.getContext("2d", BY_PROCESSOR);
      pen.drawImage(this.still, 0, 0);
      if (this.points) this.paintWire(pen);
      this.count += 1;
      const tile = this.tiles[this.count % TILES];
      for (let x = -((37 * this.count) % GRAIN); x < width; x += GRAIN) for (let y = -((61 * this.count) % GRAIN); y < height; y += GRAIN) pen.drawImage(tile, x, y);
    }

    // A shadow that is darker in the magnet, and soft at its edges.
    paintWire(pen) {
      const count = this.points.length / 3;
      const seen = [];
      for (let k = 0; k < count; k++) seen.push(this.project(this.points[3 * k], this.points[3 * k + 1], this.points[3 * k + 2]));
      pen.lineCap = "round";
      pen.lineJoin = "round";
      for (const [wider, alpha] of [[1.6, 0.3], [1, 0.75]]) {
        for (const magnetic of [false, true]) {
          pen.strokeStyle = magnetic ? `rgba(8, 9, 12, ${alpha * 1.3})` : `rgba(34, 38, 46, ${alpha})`;
          pen.beginPath();
          let open = false;
          for (let k = 0; k + 1 < count; k++) {
            const here = Boolean(this.wire.magnet[k] && this.wire.magnet[k + 1]) === magnetic;
            if (here && !open) pen.moveTo(seen[k][0], seen[k][1]);
            if (here) pen.lineTo(seen[k + 1][0], seen[k + 1][1]);
            open = here;
          }
          const slim = this.wire.onAxis ? 0.45 : 1;
          pen.lineWidth = Math.max(1.4, 2 * slim * this.wire.radius * seen[count - 1][3]) * wider * (magnetic ? 1.25 : 1);
          pen.stroke();
        }
      }
    }
  }

  // Two directions at right angles: onto the broad side of the vessel, and from its side.
  function projections(scene) {
    const front = unit(scene.bestView());
    const points = scene.bounds.points;
    const chord = sub(points.at(-1), points[0]);
    const across = sub(chord, scale(front, dot(chord, front)));
    const side = unit(cross(front, Math.hypot(...across) > 1e-9 ? across : scene.inwards));
    return [front, unit(add(scale(side, 0.94), scale(front, 0.34)))];
  }

  parts.Fluoroscopy = Fluoroscopy;
  parts.projections = projections;
})((window.magwireParts ??= {}));

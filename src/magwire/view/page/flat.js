// Paints a picture with plain strokes where there is no WebGL.
"use strict";
((parts) => {
  const { add, scale, norm } = parts.algebra;
  const { css, heat: heatColour } = parts.colours;

  const MANY = 3 * 400; // corners of triangles that are painted at once
  const STROKE = 3; // rings of the lumen that are drawn with one stroke
  const BY_PROCESSOR = { willReadFrequently: true }; // without WebGL quicker; of two canvases one alone would be read back each time

  // A line that is some pixels longer at both ends: what covers the seam to the stroke before.
  function longer(line, by) {
    const beyond = ([x, y], [fromX, fromY]) => {
      const size = Math.hypot(x - fromX, y - fromY) || 1;
      return [x + (by * (x - fromX)) / size, y + (by * (y - fromY)) / size];
    };
    return [beyond(line[0], line[1]), ...line.slice(1, -1), beyond(line.at(-1), line.at(-2))];
  }

  // Paint the outline of triangles together with one pair of strokes: all edges, and then what lies within them.
  // within: sets how the inside is painted.
  function outline(pen, { positions, indices }, project, width, within) {
    const seen = Array.from({ length: positions.length / 3 }, (_, v) => project(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
    const paint = (each) => {
      for (let k = 0; k < indices.length; k += 3) {
        if (k % MANY === 0) pen.beginPath();
        const [a, b, c] = [seen[indices[k]], seen[indices[k + 1]], seen[indices[k + 2]]];
        const turned = (b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]); // all one way round, or some would be holes
        const [from, to] = turned ? [b, a] : [a, b];
        pen.moveTo(from[0], from[1]);
        pen.lineTo(to[0], to[1]);
        pen.lineTo(c[0], c[1]);
        pen.closePath();
        if ((k + 3) % MANY === 0 || k + 3 === indices.length) each();
      }
    };
    pen.lineJoin = "round";
    pen.lineWidth = 2 * width + 1;
    paint(() => pen.stroke());
    within(pen);
    pen.lineWidth = 1; // over the seams
    paint(() => (pen.fill(), pen.stroke()));
  }

  class FlatPainter {
    constructor(canvas) {
      this.canvas = canvas;
      this.mode = "canvas";
      this.pen = canvas.getContext("2d", BY_PROCESSOR);
      this.still = document.createElement("canvas");
      this.key = "";
      this.moving = { heat: new Float32Array(0), tubes: [], arrows: [] };
      this.mesh = { rings: [], indices: [], positions: [] };
    }

    setWall(mesh) {
      this.mesh = mesh;
      this.key = "";
    }

    moveWall() {
      this.key = "";
    }

    setMoving(moving) {
      this.moving = moving;
    }

    paint(camera) {
      const { width, height } = this.canvas;
      const project = camera.projector(width, height);
      const key = [width, height, ...camera.target, camera.distance, camera.azimuth, camera.elevation].join();
      if (key !== this.key) this.paintStill(project);
      this.key = key;
      this.pen.clearRect(0, 0, width, height);
      this.pen.globalAlpha = 0.75;
      this.pen.drawImage(this.still, 0, 0);
      this.pen.globalAlpha = 1;
      this.paintHeat(project);
      for (const tube of this.moving.tubes) this.paintTube(tube, project);
      for (const arrow of this.moving.arrows) this.paintArrow(arrow, project);
    }

    // The lumen as short strokes from far to near, each with a dark edge; of triangles, the outline.
    paintStill(project) {
      const { width, height } = this.canvas;
      this.still.width = width;
      this.still.height = height;
      const pen = this.still.getContext("2d", BY_PROCESSOR);
      if (this.mesh.sheet) {
        pen.strokeStyle = parts.colours.edge;
        outline(pen, this.mesh, project, 1.5, () => (pen.fillStyle = pen.strokeStyle = parts.colours.fill));
        return;
      }
      for (const { line, radius } of this.strokes(project)) {
        for (const [colour, width] of [[parts.colours.edge, 2 * radius], [parts.colours.fill, 2 * radius - 3]]) {
          pen.strokeStyle = colour;
          pen.lineWidth = Math.max(1, width);
          pen.lineJoin = "round";
          pen.beginPath();
          longer(line, colour === parts.colours.fill ? 1.5 : 0).forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
          pen.stroke();
        }
      }
    }

    // Pieces of the branches that overlap a little, the far ones first.
    strokes(project) {
      const { rings } = this.mesh;
      const found = [];
      for (let begin = 0; begin < rings.length; ) {
        let last = begin + 1;
        while (last < rings.length && !rings[last].begins) last++;
        for (let k = begin; k < last - 1; k += STROKE) {
          const line = rings.slice(k, Math.min(k + STROKE + 2, last)).map(({ centre }) => project(...centre));
          found.push({ line, radius: rings[k].radius * line[0][3], depth: line[0][2] });
        }
        begin = last;
      }
      return found.sort((one, other) => other.depth - one.depth);
    }

    paintHeat(project) {
      const { indices, positions } = this.mesh;
      const { heat } = this.moving;
      for (let k = 0; k < indices.length; k += 3) {
        const share = (heat[indices[k]] + heat[indices[k + 1]] + heat[indices[k + 2]]) / 3;
        if (!(share > 0.02)) continue;
        const corners = [0, 1, 2].map((i) => {
          const v = 3 * indices[k + i];
          return project(positions[v], positions[v + 1], positions[v + 2]);
        });
        const [r, g, b, a] = heatColour(share);
        this.pen.fillStyle = css([r, g, b, 0.5 * a]);
        this.pen.beginPath();
        corners.forEach(([x, y], i) => (i ? this.pen.lineTo(x, y) : this.pen.moveTo(x, y)));
        this.pen.fill();
      }
    }

    paintTube({ points, radii, colours }, project) {
      const seen = points.map((point) => project(...point));
      for (const [lighter, width] of [[1, 1], [1.35, 0.45]]) {
        for (let k = 0; k + 1 < seen.length; k++) {
          const [r, g, b, a] = colours[k];
          if (a < 0.02) continue;
          this.pen.lineCap = a < 1 ? "butt" : "round"; // round ends would show through each other
          this.pen.strokeStyle = css([r * lighter, g * lighter, b * lighter, a].map((x) => Math.min(1, x)));
          this.pen.lineWidth = Math.max(1, 2 * radii[k] * seen[k][3] * width);
          this.pen.beginPath();
          this.pen.moveTo(seen[k][0], seen[k][1]);
          this.pen.lineTo(seen[k + 1][0], seen[k + 1][1]);
          this.pen.stroke();
        }
      }
    }

    paintArrow({ from, by, radius, colour }, project) {
      const length = norm(by);
      if (!(length > 0)) return;
      const head = Math.min(5 * radius, 0.6 * length);
      const neck = add(from, scale(by, 1 - head / length));
      const [a, b, c] = [from, neck, add(from, by)].map((point) => project(...point));
      this.pen.strokeStyle = this.pen.fillStyle = css(colour);
      this.pen.lineCap = "butt";
      this.pen.lineWidth = Math.max(1, 2 * radius * a[3]);
      this.pen.beginPath();
      this.pen.moveTo(a[0], a[1]);
      this.pen.lineTo(b[0], b[1]);
      this.pen.stroke();
      const [dx, dy] = [c[0] - b[0], c[1] - b[1]];
      const size = Math.hypot(dx, dy) || 1;
      const half = 0.45 * head * b[3];
      this.pen.beginPath();
      this.pen.moveTo(c[0], c[1]);
      this.pen.lineTo(b[0] - (half * dy) / size, b[1] + (half * dx) / size);
      this.pen.lineTo(b[0] + (half * dy) / size, b[1] - (half * dx) / size);
      this.pen.fill();
    }
  }

  parts.outline = outline;
  parts.FlatPainter = FlatPainter;
})((window.magwireParts ??= {}));

// A camera that goes round a target; several pictures may share one.
"use strict";
((parts) => {
  const { add, sub, scale, dot, cross, unit, multiply, lookAt, perspective } = parts.algebra;
  const ANGLE = (28 * Math.PI) / 180; // of view, upwards
  const STEEPEST = Math.PI / 2 - 1e-3;

  class Camera {
    constructor() {
      this.target = [0, 0, 0];
      this.distance = 1;
      this.azimuth = 0;
      this.elevation = 0;
      this.watchers = [];
    }

    changed() {
      for (const watcher of this.watchers) watcher();
    }

    // Unit vectors to the right, upwards and towards the eye.
    axes() {
      const [c, s] = [Math.cos(this.elevation), Math.sin(this.elevation)];
      const back = [c * Math.cos(this.azimuth), c * Math.sin(this.azimuth), s];
      const right = [-Math.sin(this.azimuth), Math.cos(this.azimuth), 0];
      return { right, up: cross(back, right), back };
    }

    look(direction) {
      const back = unit(direction);
      this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, Math.asin(back[2])));
      if (Math.hypot(back[0], back[1]) > 1e-3) this.azimuth = Math.atan2(back[1], back[0]);
      else this.azimuth = -Math.PI / 2; // x to the right, y upwards
    }

    // Stand so far away that points with their radii are in the picture.
    fit(points, radii, aspect) {
      const { right, up, back } = this.axes();
      const middle = [right, up, back].map((axis) => {
        const along = points.map((point) => dot(point, axis));
        return (Math.min(...along) + Math.max(...along)) / 2;
      });
      this.target = add(add(scale(right, middle[0]), scale(up, middle[1])), scale(back, middle[2]));
      const tangent = Math.tan(ANGLE / 2);
      this.distance = 0;
      points.forEach((point, k) => {
        const from = sub(point, this.target);
        const x = (Math.abs(dot(from, right)) + radii[k]) / (tangent * aspect);
        const y = (Math.abs(dot(from, up)) + radii[k]) / tangent;
        this.distance = Math.max(this.distance, 1.09 * Math.max(x, y) + dot(from, back));
      });
    }

    eye() {
      return add(this.target, scale(this.axes().back, this.distance));
    }

    matrix(aspect, reach) {
      const { right, up, back } = this.axes();
      const near = Math.max(this.distance - reach, 0.02 * this.distance);
      const view = lookAt(this.eye(), right, up, back);
      return multiply(perspective(ANGLE, aspect, near, this.distance + reach), view);
    }

    // Pixels that a length at the target takes in a picture of some height.
    pixels(height) {
      return height / (2 * Math.tan(ANGLE / 2) * this.distance);
    }

    // A function that gives x, y [pixels], depth along the view [m] and pixels a metre there.
    projector(width, height) {
      const { right, up, back } = this.axes();
      const eye = this.eye();
      const k = height / (2 * Math.tan(ANGLE / 2));
      return (x, y, z) => {
        const from = [x - eye[0], y - eye[1], z - eye[2]];
        const depth = Math.max(-dot(from, back), 1e-6 * this.distance);
        const there = k / depth;
        return [width / 2 + there * dot(from, right), height / 2 - there * dot(from, up), depth, there];
      };
    }

    // Drag turns, with the right button or shift moves, the wheel comes closer, two fingers do both.
    attach(element) {
      const held = new Map();
      element.addEventListener("pointerdown", (event) => {
        element.setPointerCapture(event.pointerId);
        held.set(event.pointerId, [event.clientX, event.clientY]);
      });
      const release = (event) => held.delete(event.pointerId);
      element.addEventListener("pointerup", release);
      element.addEventListener("pointercancel", release);
      element.addEventListener("pointermove", (event) => {
        const before = held.get(event.pointerId);
        if (!before) return;
        const spread = () => {
          const [a, b] = [...held.values()];
          return Math.hypot(a[0] - b[0], a[1] - b[1]);
        };
        const apart = held.size === 2 ? spread() : 0;
        held.set(event.pointerId, [event.clientX, event.clientY]);
        const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
        if (held.size === 2) this.distance *= apart / Math.max(spread(), 1);
        if (event.shiftKey || event.buttons & 6 || held.size === 2) this.pan(dx, dy, element.clientHeight);
        else this.turn(dx, dy);
        this.changed();
      });
      element.addEventListener("contextmenu", (event) => event.preventDefault());
      element.addEventListener(
        "wheel",
        (event) => {
          event.preventDefault();
          this.distance *= Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 1e-3);
          this.changed();
        },
        { passive: false },
      );
    }

    turn(dx, dy) {
      this.azimuth -= 0.008 * dx;
      this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, this.elevation + 0.008 * dy));
    }

    pan(dx, dy, height) {
      const { right, up } = this.axes();
      const k = 1 / this.pixels(height);
      this.target = add(this.target, add(scale(right, -k * dx), scale(up, k * dy)));
    }
  }

  parts.Camera = Camera;
})((window.magwireParts ??= {}));

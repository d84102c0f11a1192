// The field by direction and strength, as the camera sees it; or a slider for each input of an actuator.
"use strict";
((parts) => {
  const { add, scale, dot, norm, unit, cross } = parts.algebra;

  class FieldPad {
    // changed: called with a vector [T].
    constructor(holder, camera, { most, changed }) {
      Object.assign(this, { camera, changed, most });
      this.direction = [1, 0, 0];
      this.strength = 0;
      this.canvas = document.createElement("canvas");
      this.canvas.title = "Drag: direction of the field as seen in 3D; double click: towards or away from you";
      [this.canvas.width, this.canvas.height] = [176, 176];
      this.slider = Object.assign(document.createElement("input"), { type: "range", min: 0, max: 1e3 * most, step: 0.1, value: 0, title: "Strength of the field (keys U and O)" });
      this.slider.setAttribute("aria-label", "Strength of the field");
      this.reading = document.createElement("output");
      holder.append(this.canvas, this.slider, this.reading);
      this.slider.addEventListener("input", () => this.set(this.direction, Number(this.slider.value) / 1e3));
      this.canvas.addEventListener("pointerdown", (event) => {
        this.canvas.setPointerCapture(event.pointerId);
        this.point(event);
      });
      this.canvas.addEventListener("pointermove", (event) => event.buttons && this.point(event));
      this.canvas.addEventListener("dblclick", () => {
        const { back } = this.camera.axes();
        this.set(add(this.direction, scale(back, -2 * dot(this.direction, back))), this.strength);
      });
      camera.watchers.push(() => this.paint());
    }

    get vector() {
      return scale(this.direction, this.strength);
    }

    point(event) {
      const { right, up, back } = this.camera.axes();
      const half = this.canvas.clientWidth / 2;
      let [x, y] = [event.offsetX / half - 1, 1 - event.offsetY / half].map((value) => value / 0.86);
      const size = Math.hypot(x, y);
      if (size > 1) [x, y] = [x / size, y / size];
      const side = dot(this.direction, back) < -1e-9 ? -1 : 1;
      const depth = side * Math.sqrt(Math.max(0, 1 - x * x - y * y));
      this.set(unit(add(add(scale(right, x), scale(up, y)), scale(back, depth))), this.strength || 0.25 * this.most);
    }

    // Turn about the camera's axes [rad].
    turn(sideways, upwards) {
      const { right, up, back } = this.camera.axes();
      const moved = add(add(this.direction, scale(cross(up, this.direction), sideways)), scale(cross(right, this.direction), -upwards));
      this.set(unit(norm(moved) > 1e-6 ? moved : back), this.strength);
    }

    set(direction, strength) {
      this.direction = unit(direction);
      this.strength = Math.max(0, Math.min(this.most, strength));
      this.changed(this.vector);
      this.show(this.vector);
    }

    // Show a field that was set elsewhere [T].
    show(vector) {
      this.strength = norm(vector);
      if (this.strength > 1e-9) this.direction = unit(vector);
      this.slider.value = 1e3 * this.strength;
      this.reading.textContent = `${(1e3 * this.strength).toFixed(1)} mT`;
      this.reading.title = vector.map((value, k) => `B${"xyz"[k]} ${(1e3 * value).toFixed(2)} mT`).join(", ");
      this.paint();
    }

    suggest(vector) {
      this.suggested = vector;
      this.paint();
    }

    paint() {
      const pen = this.canvas.getContext("2d");
      const { width } = this.canvas;
      const half = width / 2;
      pen.clearRect(0, 0, width, width);
      pen.lineWidth = 2;
      pen.strokeStyle = "#c9d3db";
      pen.fillStyle = "#f6f9fb";
      pen.beginPath();
      pen.arc(half, half, 0.86 * half, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
      pen.beginPath();
      for (const [a, b] of [[[-1, 0], [1, 0]], [[0, -1], [0, 1]]]) {
        pen.moveTo(half + 0.86 * half * a[0], half + 0.86 * half * a[1]);
        pen.lineTo(half + 0.86 * half * b[0], half + 0.86 * half * b[1]);
      }
      pen.lineWidth = 1;
      pen.stroke();
      if (this.suggested && norm(this.suggested) > 1e-5) this.arrow(pen, unit(this.suggested), "#009e73", 3);
      this.arrow(pen, this.direction, this.strength > 0 ? "#0072b2" : "#9fb0bd", 5);
    }

    arrow(pen, direction, colour, thick) {
      const { right, up, back } = this.camera.axes();
      const half = this.canvas.width / 2;
      const [x, y] = [half + 0.86 * half * dot(direction, right), half - 0.86 * half * dot(direction, up)];
      const towards = dot(direction, back) > -0.02; // across the view counts as towards
      pen.strokeStyle = pen.fillStyle = colour;
      pen.lineWidth = thick;
      pen.setLineDash(towards ? [] : [6, 5]);
      pen.beginPath();
      pen.moveTo(half, half);
      pen.lineTo(x, y);
      pen.stroke();
      pen.setLineDash([]);
      pen.beginPath();
      pen.arc(x, y, 2 + 1.6 * thick, 0, 2 * Math.PI);
      if (towards) pen.fill();
      else pen.stroke();
    }
  }

  // An input of an actuator as it is read: lengths in mm, with as many digits as its range needs.
  function reader({ unit, low, high }) {
    const [factor, name] = unit === "m" ? [1e3, "mm"] : [1, unit];
    const digits = Math.max(0, 3 - Math.ceil(Math.log10(factor * (high - low) || 1)));
    return (value) => `${(factor * value).toFixed(digits).replace(/^-(?=0(\.0*)?$)/, "")} ${name}`;
  }

  class Sliders {
    // changed: called with all inputs, where they are to go; gives the number that is answered when it is heard.
    constructor(holder, inputs, changed) {
      this.asked = 0;
      holder.classList.add("inputs");
      this.rows = inputs.map((input, k) => {
        const { name, low, high } = input;
        const label = document.createElement("label");
        const slider = Object.assign(document.createElement("input"), { type: "range", min: low, max: high, step: (high - low) / 400, value: 0 });
        const reading = document.createElement("output");
        label.append(name, slider, reading);
        holder.append(label);
        slider.addEventListener("input", () => {
          this.wanted[k] = Number(slider.value);
          this.asked = changed(this.wanted);
        });
        return { slider, reading, read: reader(input) };
      });
    }

    // values: what they are; wanted: where they are on their way to; heard: number of what was heard last.
    show(values, wanted, heard) {
      if (heard >= this.asked) this.wanted = wanted;
      this.rows.forEach(({ slider, reading, read }, k) => {
        if (!slider.matches(":active")) slider.value = this.wanted[k];
        reading.textContent = read(values[k]);
      });
    }

    suggest() {}
    turn() {}
  }

  parts.FieldPad = FieldPad;
  parts.Sliders = Sliders;
})((window.magwireParts ??= {}));

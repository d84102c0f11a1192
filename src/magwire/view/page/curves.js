// Curves over time below each other, with a cursor and the numbers of the records at it.
"use strict";
((parts) => {
  const MARGIN = { left: 46, right: 10, top: 6, bottom: 18 };

  // Round numbers between two bounds.
  function ticks(low, high, most) {
    const raw = (high - low) / most;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw * 0.999);
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
  }

  const decades = (low, high) => {
    const found = [];
    const every = Math.max(1, Math.ceil((high - low) / 3));
    for (let k = Math.ceil(low - 1e-9); k <= high + 1e-9; k += every) found.push(k);
    return found;
  };

  function shortly(value) {
    if (!Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e5 || size < 1e-3) return value.toExponential(2);
    return value.toPrecision(4).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  }

  // A panel: {title, unit, log, series: [{name, colour, values, run, dashed}], times by run}.
  class Panel {
    constructor(holder, panel, watch) {
      Object.assign(this, panel);
      this.element = document.createElement("section");
      this.element.className = "panel";
      const head = document.createElement("h3");
      head.textContent = `${this.title} `;
      const unit = document.createElement("span");
      unit.textContent = this.unit;
      head.append(unit);
      this.legend = document.createElement("div");
      this.legend.className = "legend";
      const runs = new Set(this.series.map(({ run }) => run)).size;
      if (runs > 1) this.legend.style.gridTemplateColumns = `repeat(${this.series.length / runs}, max-content)`;
      this.readings = this.series.map((series) => {
        const entry = document.createElement("span");
        const swatch = document.createElement("i");
        swatch.style.borderTop = `2.5px ${series.dashed ? "dashed" : "solid"} ${series.colour}`;
        const value = document.createElement("b");
        entry.append(swatch, `${series.name} `, value);
        this.legend.append(entry);
        return value;
      });
      this.canvas = document.createElement("canvas");
      this.element.append(head, this.legend, this.canvas);
      holder.append(this.element);
      this.still = document.createElement("canvas");
      this.markers = [];
      this.bounds();
      this.attach(watch);
      new ResizeObserver(() => this.resize()).observe(this.canvas);
    }

    attach(watch) {
      const tell = (event) => {
        if (event.type === "pointermove" && !event.buttons) return;
        const share = (event.offsetX - MARGIN.left) / (this.canvas.clientWidth - MARGIN.left - MARGIN.right);
        watch(this.span[0] + Math.max(0, Math.min(1, share)) * (this.span[1] - this.span[0]));
      };
      this.canvas.addEventListener("pointerdown", (event) => {
        this.canvas.setPointerCapture(event.pointerId);
        tell(event);
      });
      this.canvas.addEventListener("pointermove", tell);
    }

    bounds() {
      let [low, high] = this.log ? [Infinity, -Infinity] : [0, 0];
      for (const { values } of this.series)
        for (const value of values) {
          if (!Number.isFinite(value) || (this.log && value <= 0)) continue;
          low = Math.min(low, value);
          high = Math.max(high, value);
        }
      this.empty = !(high > low) && !(this.log && high > 0);
      if (this.log) {
        [low, high] = this.empty ? [-1, 0] : [Math.log10(low), Math.log10(high)];
        const room = Math.max(0.08 * (high - low), 0.25);
        this.range = [low - room, high + room];
      } else {
        if (this.empty) [low, high] = [low, low + 1];
        const room = 0.09 * (high - low);
        this.range = [low < 0 ? low - room : low, high + room];
      }
    }

    // Pixels of a time and of a value, and back.
    x(time) {
      const width = this.canvas.clientWidth - MARGIN.left - MARGIN.right;
      return MARGIN.left + (width * (time - this.span[0])) / (this.span[1] - this.span[0] || 1);
    }

    y(value) {
      const height = this.canvas.clientHeight - MARGIN.top - MARGIN.bottom;
      const level = this.log ? Math.log10(value) : value;
      return MARGIN.top + height * (1 - (level - this.range[0]) / (this.range[1] - this.range[0]));
    }

    valueAt(y) {
      const height = this.canvas.clientHeight - MARGIN.top - MARGIN.bottom;
      const level = this.range[0] + (1 - (y - MARGIN.top) / height) * (this.range[1] - this.range[0]);
      return this.log ? 10 ** level : level;
    }

    resize() {
      const ratio = window.devicePixelRatio || 1;
      const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
      if (!width || !height) return;
      for (const canvas of [this.canvas, this.still]) {
        canvas.width = Math.round(width * ratio);
        canvas.height = Math.round(height * ratio);
      }
      const pen = this.still.getContext("2d");
      pen.scale(ratio, ratio);
      this.paintAxes(pen, width, height);
      this.series.toReversed().forEach((series) => this.paintLine(pen, series));
      if (this.records) this.show(this.records);
    }

    paintAxes(pen, width, height) {
      const { ink, muted, grid } = parts.colours;
      pen.font = "10.5px system-ui, sans-serif";
      pen.lineWidth = 1;
      pen.textBaseline = "middle";
      pen.textAlign = "right";
      const levels = this.log ? decades(...this.range).map((k) => 10 ** k) : ticks(...this.range, 4);
      for (const value of levels) {
        const y = Math.round(this.y(value)) + 0.5;
        pen.strokeStyle = value === 0 ? muted : grid;
        pen.beginPath();
        pen.moveTo(MARGIN.left, y);
        pen.lineTo(width - MARGIN.right, y);
        pen.stroke();
        pen.fillStyle = ink;
        pen.fillText(shortly(Number(value.toPrecision(3))), MARGIN.left - 6, y);
      }
      pen.textBaseline = "alphabetic";
      pen.textAlign = "center";
      pen.fillStyle = muted;
      const ends = ticks(...this.span, 5);
      for (const time of ends) {
        const last = time > this.span[1] - 0.04 * (this.span[1] - this.span[0]);
        pen.textAlign = last ? "right" : "center";
        const words = `${shortly(Number(time.toPrecision(6)))}${time === ends.at(-1) ? " s" : ""}`;
        pen.fillText(words, last ? width - MARGIN.right + 2 : this.x(time), height - 4);
      }
      if (!this.empty) return;
      pen.textAlign = "center";
      pen.font = "italic 12px system-ui, sans-serif";
      pen.fillText(this.none, (MARGIN.left + width) / 2, height / 2 - 6);
    }

    paintLine(pen, { values, run, colour, dashed }) {
      const times = this.times[run];
      pen.strokeStyle = colour;
      pen.lineWidth = dashed ? 1.5 : 1.9;
      pen.setLineDash(dashed ? [5, 3] : []);
      pen.lineJoin = "round";
      pen.beginPath();
      let open = false;
      for (let k = 0; k < times.length; k++) {
        const known = Number.isFinite(values[k]) && !(this.log && values[k] <= 0);
        if (known && open) pen.lineTo(this.x(times[k]), this.y(values[k]));
        else if (known) pen.moveTo(this.x(times[k]), this.y(values[k]));
        open = known;
      }
      pen.stroke();
      pen.setLineDash([]);
    }

    // records: index of the record that is shown, for each run.
    show(records) {
      this.records = records;
      const pen = this.canvas.getContext("2d");
      const ratio = window.devicePixelRatio || 1;
      pen.setTransform(1, 0, 0, 1, 0, 0);
      pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
      if (this.still.width) pen.drawImage(this.still, 0, 0);
      pen.scale(ratio, ratio);
      const cursor = Math.max(...records.map((record, run) => this.times[run][record]));
      pen.strokeStyle = parts.colours.ink;
      pen.globalAlpha = 0.55;
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(this.x(cursor), MARGIN.top);
      pen.lineTo(this.x(cursor), this.canvas.clientHeight - MARGIN.bottom);
      pen.stroke();
      pen.globalAlpha = 1;
      this.markers = this.series.map((series, k) => this.mark(pen, series, records[series.run], this.readings[k]));
    }

    mark(pen, { name, values, run, colour }, record, reading) {
      const value = values[record];
      reading.textContent = shortly(value);
      if (!Number.isFinite(value) || (this.log && value <= 0)) return { name, run, x: NaN, y: NaN };
      const [x, y] = [this.x(this.times[run][record]), this.y(value)];
      pen.beginPath();
      pen.arc(x, y, 4, 0, 2 * Math.PI);
      pen.fillStyle = colour;
      pen.fill();
      pen.strokeStyle = "#fff";
      pen.lineWidth = 1.2;
      pen.stroke();
      return { name, run, x, y };
    }
  }

  parts.Panel = Panel;
  parts.shortly = shortly;
})((window.magwireParts ??= {}));

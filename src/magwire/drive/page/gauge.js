// A dial for the wall's force: green, amber up to the limit, red from there.
"use strict";
((parts) => {
  const GREEN = 0.5; // up to this part of the limit
  const END = 1.5; // of the dial, over the limit
  const SIZE = 70; // radius of the dial
  const angle = (share) => Math.PI * (1 - Math.min(share / END, 1));
  const on = (share, radius) => [100 + radius * Math.cos(angle(share)), 92 - radius * Math.sin(angle(share))];

  function arc(from, to, colour) {
    const [x, y] = on(from, SIZE);
    const [toX, toY] = on(to, SIZE);
    return `<path d="M${x} ${y}A${SIZE} ${SIZE} 0 0 1 ${toX} ${toY}" stroke="${colour}"/>`;
  }

  class Gauge {
    constructor(holder) {
      this.holder = holder;
      holder.innerHTML = `<svg viewBox="0 0 200 112" role="img" aria-label="Force of the wall">
        <g class="dial">${arc(0, GREEN, "#2e9e5b")}${arc(GREEN, 1, "#e69f00")}${arc(1, END, "#c4320a")}</g>
        <line class="peak"/><line class="needle"/><circle cx="100" cy="92" r="5"/></svg>
        <output></output><small></small>`;
      [this.needle, this.peak, this.output, this.words] = [".needle", ".peak", "output", "small"].map((name) => holder.querySelector(name));
    }

    // force, peak, limit [N].
    show({ force, peak, limit, tip }) {
      this.force = force;
      this.level = force >= limit ? "red" : force >= GREEN * limit ? "amber" : "green";
      this.holder.dataset.level = this.level;
      this.point(this.needle, force / limit, 14, 60);
      this.point(this.peak, peak / limit, 62, 80);
      this.output.textContent = parts.newtons(force);
      this.words.textContent = `tip ${parts.newtons(tip)} · peak ${parts.newtons(peak)}`;
    }

    point(line, share, from, to) {
      const [[x, y], [toX, toY]] = [on(share, from), on(share, to)];
      Object.entries({ x1: x, y1: y, x2: toX, y2: toY }).forEach(([name, value]) => line.setAttribute(name, value.toFixed(2)));
    }
  }

  parts.Gauge = Gauge;
  parts.newtons = (force) => {
    const [size, unit] = Math.abs(force) >= 1 ? [force, "N"] : [Math.abs(force) < 5e-6 ? 0 : 1e3 * force, "mN"];
    return `${size >= 100 ? size.toFixed(0) : size >= 10 ? size.toFixed(1) : size.toFixed(2)} ${unit}`;
  };
})((window.magwireParts ??= {}));

// The colours of magwire's figures, which the colour-blind tell apart.
"use strict";
((parts) => {
  const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
  const HEAT = ["#f7d9a8", "#f2a65a", "#d55e00", "#8f2f0a", "#3d1206"].map(rgb);

  // Of the wall by its pressure over the largest one: colour and opacity.
  function heat(share) {
    const t = Math.max(0, Math.min(1, share));
    const k = Math.min(HEAT.length - 2, Math.floor(t * (HEAT.length - 1)));
    const part = t * (HEAT.length - 1) - k;
    const colour = HEAT[k].map((value, i) => value + part * (HEAT[k + 1][i] - value));
    return [...colour, Math.min(0.92, Math.sqrt(t) * 1.2)];
  }

  parts.colours = {
    rgb,
    heat,
    css: ([r, g, b, a = 1]) => `rgba(${Math.round(255 * r)},${Math.round(255 * g)},${Math.round(255 * b)},${a})`,
    lumen: rgb("#7f97ab"),
    edge: "#8ea2b3",
    fill: "#eaf0f5",
    wire: rgb("#55718a"),
    magnet: rgb("#1b2530"),
    force: rgb("#d55e00"),
    field: rgb("#0072b2"),
    suggested: rgb("#009e73"),
    ink: "#22303c",
    muted: "#6b7a87",
    grid: "#e3e8ec",
    components: ["#0072b2", "#d55e00", "#009e73"],
  };
})((window.magwireParts ??= {}));

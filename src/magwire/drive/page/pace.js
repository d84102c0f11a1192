// How long pictures take, by the time until the browser has room for the next one.
"use strict";
((parts) => {
  const LOOKS = 24; // pictures by whose middle one they are judged: some of the first take long anywhere
  const AT_MOST = 40; // ms

  class Pace {
    // slow: called each time that pictures take too long.
    constructor(slow) {
      this.slow = slow;
      this.spans = [];
    }

    took(span) {
      this.spans.push(span);
      if (this.spans.length < LOOKS) return;
      const middle = this.spans.sort((one, other) => one - other)[LOOKS / 2];
      this.spans = [];
      if (middle > AT_MOST) this.slow();
    }
  }

  parts.Pace = Pace;
})((window.magwireParts ??= {}));

// Time: playing, scrubbing, jumping from impact to impact.

class Player {
  constructor(duration, onTime) {
    this.duration = duration;
    this.onTime = onTime;
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.onState = () => {};
  }

  /** Moves to an instant; `following` is true while playing. */
  seek(t, following = false) {
    this.time = Math.min(Math.max(t, 0), this.duration);
    this.onTime(this.time, following);
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.duration) this.seek(0);
    this.playing = true;
    this.last = null;
    this.onState(true);
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.playing = false;
    this.onState(false);
  }

  tick(now) {
    if (!this.playing) return;
    // A tab in the background must not jump ahead on return.
    const passed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    this.seek(this.time + passed * this.speed, true);
    if (this.time >= this.duration) this.pause();
    else requestAnimationFrame((next) => this.tick(next));
  }
}

/** Instants worth jumping to: the peak of each group of impacts less than `apart` seconds apart; `hardest` is when that impact begins. */
function gatherImpacts(impacts, apart) {
  const groups = [];
  for (const impact of impacts) {
    const group = groups[groups.length - 1];
    if (group && impact.start - group.end < apart) {
      group.end = Math.max(group.end, impact.end);
      if (impact.peak > group.peak) Object.assign(group, { peak: impact.peak, at: impact.at, contact: impact.contact, hardest: impact.start });
    } else {
      groups.push({ ...impact, hardest: impact.start });
    }
  }
  return groups;
}

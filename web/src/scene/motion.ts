// Fewer pixels while a large model is turned on a slow machine, so that it follows the hand; all of them as soon as it
// rests.

/** Entities in a layer from which on a frame may take longer than a hand notices. */
const large = 50_000;
/** Milliseconds from one frame to the next. */
const slow = 40;
/** Below, lines are a blur, and vertices take the time. */
const fewer = 0.6;
/** Milliseconds without a movement until the model rests. */
const rest = 160;

export class Motion {
  /** Of the pixels along each side, those to be drawn. */
  share = 1;
  private last: number | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly rested: () => void;

  /** `rested`: called once a movement with fewer pixels is over. */
  constructor(rested: () => void) {
    this.rested = rested;
  }

  /** The camera was moved by hand, with layers of up to `entities` in sight. */
  moved(entities: number): void {
    if (entities < large) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.end(), rest);
  }

  /** A frame is about to be drawn at `now`, in milliseconds. */
  frame(now: number): void {
    if (this.timer === undefined) return;
    // No way back before it rests: a picture that is sharp now and then is worse than either.
    if (this.last !== null && now - this.last > slow) this.share = fewer;
    this.last = now;
  }

  private end(): void {
    this.timer = undefined;
    this.last = null;
    if (this.share === 1) return;
    this.share = 1;
    this.rested();
  }
}

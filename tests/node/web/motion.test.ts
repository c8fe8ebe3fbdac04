// How many pixels are drawn while a large model is turned.
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Motion } from '../../../web/src/scene/motion.ts';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

/** Moves and draws `frames` times, a frame taking `took` milliseconds; the shares that were drawn. */
function turn(motion: Motion, entities: number, took: number, frames: number): number[] {
  return Array.from({ length: frames }, () => {
    motion.moved(entities);
    vi.advanceTimersByTime(took);
    motion.frame(performance.now());
    return motion.share;
  });
}

it('draws fewer pixels of a large model where frames are slow, and all of them once it rests', () => {
  const rested = vi.fn();
  const motion = new Motion(rested);
  expect(turn(motion, 100_000, 80, 4)).toEqual([1, 0.6, 0.6, 0.6]);
  expect(turn(motion, 100_000, 16, 2)).toEqual([0.6, 0.6]); // no flicker in between
  expect(rested).not.toHaveBeenCalled();
  vi.advanceTimersByTime(200);
  expect(motion.share).toBe(1);
  expect(rested).toHaveBeenCalledOnce();
  motion.frame(performance.now());
  expect(motion.share).toBe(1);
  // The pause since then is no slow frame.
  vi.advanceTimersByTime(5000);
  expect(turn(motion, 100_000, 16, 3)).toEqual([1, 1, 1]);
});

it('draws all pixels of a small model, and where frames are quick', () => {
  const rested = vi.fn();
  const motion = new Motion(rested);
  expect(turn(motion, 1000, 80, 3)).toEqual([1, 1, 1]);
  expect(turn(motion, 100_000, 16, 3)).toEqual([1, 1, 1]);
  vi.advanceTimersByTime(200);
  expect(rested).not.toHaveBeenCalled();
});

// Clicks and hovering on the canvas, told apart from dragging.
export interface At {
  x: number;
  y: number;
}

const stillWithin = 5; // CSS pixels

export interface PointerEvents {
  /** A press without a drag; places in CSS pixels from the canvas's upper left corner. */
  clicked(at: At, event: PointerEvent): void;
  /** At most once a frame, while no button is down; null: the pointer left. */
  hovered(at: At | null): void;
}

export function listenToPointer(canvas: HTMLCanvasElement, events: PointerEvents): void {
  let down: PointerEvent | null = null;
  let last: PointerEvent | null = null;
  const place = (event: PointerEvent): At => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener('pointerdown', (event) => {
    down = event;
  });
  canvas.addEventListener('pointerup', (event) => {
    const from = down;
    down = null;
    if (!from || from.pointerId !== event.pointerId || event.button !== 0) return;
    if (Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) < stillWithin)
      events.clicked(place(event), event);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'touch' || down || event.buttons) return;
    if (!last)
      requestAnimationFrame(() => {
        if (last) events.hovered(place(last));
        last = null;
      });
    last = event;
  });
  canvas.addEventListener('pointerleave', () => {
    last = null;
    events.hovered(null);
  });
}

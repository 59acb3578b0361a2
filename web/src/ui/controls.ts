/** Keys, mouse and touch to movements. */

export interface Movement {
  forward: number; // -1..1
  right: number;
  turn: number; // counter-clockwise
  tilt: number; // upwards
  fast: boolean;
}

/** By the place of a key, so that WASD is a hand's shape on any keyboard. */
const kKeys: { [code: string]: [keyof Omit<Movement, 'fast'>, number] } = {
  KeyW: ['forward', 1], KeyS: ['forward', -1], KeyA: ['right', -1], KeyD: ['right', 1],
  ArrowUp: ['forward', 1], ArrowDown: ['forward', -1], ArrowLeft: ['turn', 1], ArrowRight: ['turn', -1],
  PageUp: ['tilt', 1], PageDown: ['tilt', -1],
};

/** Movements in which keys that are held add up to. */
export function movementOf(held: ReadonlySet<string>, fast: boolean): Movement {
  const movement: Movement = { forward: 0, right: 0, turn: 0, tilt: 0, fast };
  for (const code of held) {
    const [axis, amount] = kKeys[code] ?? [];
    if (axis) movement[axis] = Math.max(-1, Math.min(1, movement[axis] + amount!));
  }
  return movement;
}

export const isStill = (m: Movement): boolean => m.forward === 0 && m.right === 0 && m.turn === 0 && m.tilt === 0;

const inForm = (target: EventTarget | null): boolean =>
  target instanceof HTMLInputElement || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;

export class Controls {
  private readonly held = new Set<string>();
  private readonly fresh = new Set<string>(); // pressed since movements were last asked for
  private readonly tapped = new Set<string>(); // and let go again: on slow devices too each press counts
  private fast = false;
  private readonly pointers = new Map<number, { x: number; y: number }>();

  /** `look`: pixels that the picture is dragged by; `wake`: something is held or let go. */
  constructor(
    private readonly canvas: HTMLCanvasElement, private readonly look: (dx: number, dy: number) => void,
    private readonly wake: () => void, private readonly command: (key: string) => boolean,
  ) {
    window.addEventListener('keydown', (event) => this.keyDown(event));
    window.addEventListener('keyup', (event) => this.release(event.code, event.shiftKey));
    window.addEventListener('blur', () => this.releaseAll());
    document.addEventListener('visibilitychange', () => this.releaseAll());
    canvas.addEventListener('pointerdown', (event) => {
      canvas.focus({ preventScroll: true });
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    canvas.addEventListener('pointermove', (event) => this.pointerMove(event));
    for (const end of ['pointerup', 'pointercancel'] as const)
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    this.stick();
  }

  /** Of the time until the next call. */
  takeMovement(): Movement {
    const movement = movementOf(new Set([...this.held, ...this.tapped]), this.fast);
    this.fresh.clear();
    this.tapped.clear();
    return movement;
  }

  private press(code: string): void {
    if (!this.held.has(code)) this.fresh.add(code);
    this.held.add(code);
    this.wake();
  }

  lockPointer(): void {
    if (document.pointerLockElement === this.canvas) document.exitPointerLock();
    else void Promise.resolve(this.canvas.requestPointerLock()).catch(() => undefined); // the browser may refuse
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    this.fast = event.shiftKey;
    if (inForm(event.target) && event.key !== 'Escape') return;
    if (kKeys[event.code]) {
      this.press(event.code);
      event.preventDefault();
    } else if (!event.repeat && this.command(event.key)) {
      event.preventDefault();
    }
  }

  private release(code: string, shift: boolean): void {
    this.fast = shift;
    if (this.fresh.delete(code)) this.tapped.add(code);
    if (this.held.delete(code)) this.wake();
  }

  private releaseAll(): void {
    this.held.clear();
    this.pointers.clear();
    this.wake();
  }

  private pointerMove(event: PointerEvent): void {
    if (document.pointerLockElement === this.canvas) {
      this.look(-event.movementX, -event.movementY);
      return;
    }
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 1) this.look(event.clientX - last.x, event.clientY - last.y);
  }

  /** Buttons that walk while they are held, by touch or by Space and Enter. */
  private stick(): void {
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-walk]')) {
      const code = button.dataset.walk!;
      const hold = () => this.press(code);
      const letGo = () => this.release(code, false);
      button.addEventListener('pointerdown', (event) => {
        button.setPointerCapture(event.pointerId);
        hold();
      });
      for (const end of ['pointerup', 'pointercancel', 'blur'] as const) button.addEventListener(end, letGo);
      button.addEventListener('keydown', (event) => {
        if (event.code === 'Space' || event.code === 'Enter') hold();
      });
      button.addEventListener('keyup', letGo);
    }
  }
}

/** How fine a picture can be while it moves, so that it moves smoothly; at rest it is drawn in full. */

const SLOW_MS = 60;
const FAST_MS = 30;
const COARSEST = 3;
const REST_MS = 160;

let software: boolean | undefined;

/** Whether pictures are drawn without a graphics card. */
export function isSoftware(): boolean {
  if (software === undefined) {
    const gl = document.createElement("canvas").getContext("webgl2");
    const info = gl?.getExtension("WEBGL_debug_renderer_info");
    const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
    software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
    gl?.getExtension("WEBGL_lose_context")?.loseContext();
  }
  return software;
}

export class Quality {
  /** 1 for the full picture; 2 for half as many pixels across, and so on. */
  coarse: number;
  private readonly times: number[] = [];
  private moved = -Infinity;
  private rested = true;
  private latest = 0;

  /** A renderer without a graphics card starts coarse. */
  constructor(software: boolean) {
    this.coarse = software ? 2.5 : 1;
  }

  /** Note that the picture changes. */
  move(now: number): void {
    this.moved = now;
    this.rested = false;
  }

  /** Take the picture as one that stands still. */
  settle(): void {
    this.rested = true;
  }

  get moving(): boolean {
    return !this.rested;
  }

  /** Whether the picture has stood still and is to be drawn once more, in full. */
  rests(now: number): boolean {
    if (this.rested || now - this.moved < Math.max(REST_MS, 1.5 * this.latest)) return false;
    this.rested = true;
    this.times.length = 0;
    return true;
  }

  /** Note how long a picture took while moving. */
  took(milliseconds: number): void {
    this.latest = milliseconds;
    if (milliseconds > 1000) return;
    this.times.push(milliseconds);
    if (this.times.length < 6) return;
    const middle = [...this.times].sort((a, b) => a - b)[this.times.length >> 1];
    this.times.length = 0;
    if (middle > SLOW_MS) this.coarse = Math.min(COARSEST, this.coarse * 1.25);
    else if (middle < FAST_MS) this.coarse = Math.max(1, this.coarse / 1.12);
  }
}

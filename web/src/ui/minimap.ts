/** The plan: regions, the eye and where it looks, its region, and the captures that the picture is painted from. */

import type { Storey } from '../bundle/types';
import type { Box } from '../geometry/polygon';
import { directionOf, type Vec2 } from '../geometry/vector';

export interface MapState {
  eye: Vec2;
  yaw: number;
  fov: number; // horizontal
  region: number;
  captures: readonly number[]; // cameras in use
  isFull: (camera: number) => boolean;
}

const kColours = {
  region: '#3b4150', border: '#6c7486', own: '#6a5126', ownBorder: '#ffb454', outline: '#c9ced9', full: '#6fd08c', coarse: '#8fb7ff', eye: '#ffffff',
};

export class Minimap {
  private readonly context: CanvasRenderingContext2D;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly legend: HTMLElement) {
    this.context = canvas.getContext('2d')!;
  }

  draw(storey: Storey, box: Box, state: MapState): void {
    const { canvas, context: c } = this;
    const density = Math.min(3, window.devicePixelRatio || 1), width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0) return;
    if (canvas.width !== Math.round(width * density)) canvas.width = Math.round(width * density);
    if (canvas.height !== Math.round(height * density)) canvas.height = Math.round(height * density);
    const margin = 8, across = box.max[0] - box.min[0], down = box.max[1] - box.min[1];
    const scale = Math.min((width - 2 * margin) / across, (height - 2 * margin) / down);
    const to = (p: Vec2): Vec2 => [
      0.5 * width + scale * (p[0] - 0.5 * (box.min[0] + box.max[0])),
      0.5 * height - scale * (p[1] - 0.5 * (box.min[1] + box.max[1])),
    ];
    const trace = (points: readonly Vec2[]) => {
      c.beginPath();
      points.map(to).forEach(([x, y]) => c.lineTo(x, y));
      c.closePath();
    };
    c.setTransform(density, 0, 0, density, 0, 0);
    c.clearRect(0, 0, width, height);
    c.lineWidth = 1;
    storey.regions.forEach((region, number) => {
      if (number === state.region) return;
      trace(region.polygon);
      c.fillStyle = kColours.region;
      c.fill();
      c.strokeStyle = kColours.border;
      c.stroke();
    });
    if (state.region >= 0) {
      trace(storey.regions[state.region].polygon);
      c.fillStyle = kColours.own;
      c.fill();
      c.strokeStyle = kColours.ownBorder;
      c.lineWidth = 2;
      c.stroke();
    }
    c.strokeStyle = kColours.outline;
    c.lineWidth = 1.5;
    storey.outline.forEach((ring) => {
      trace(ring);
      c.stroke();
    });
    let full = 0;
    for (const camera of state.captures) {
      const { position, middle } = storey.cameras[camera];
      const sharp = state.isFull(camera);
      if (sharp) ++full;
      const [x, y] = to(position), [dx, dy] = directionOf(middle);
      c.strokeStyle = c.fillStyle = sharp ? kColours.full : kColours.coarse;
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(x + 9 * dx, y - 9 * dy);
      c.stroke();
      c.beginPath();
      c.arc(x, y, 2.2, 0, 2 * Math.PI);
      c.fill();
    }
    const [x, y] = to(state.eye);
    c.fillStyle = 'rgb(255 255 255 / 35%)';
    c.beginPath();
    c.moveTo(x, y);
    c.arc(x, y, 26, -state.yaw - 0.5 * state.fov, -state.yaw + 0.5 * state.fov);
    c.closePath();
    c.fill();
    c.fillStyle = kColours.eye;
    c.beginPath();
    c.arc(x, y, 3.5, 0, 2 * Math.PI);
    c.fill();
    this.legend.textContent = `painted from ${full} full and ${state.captures.length - full} coarse captures`;
    canvas.setAttribute(
      'aria-label',
      `Map: you are in region ${state.region + 1} of ${storey.regions.length}, ${this.legend.textContent}`,
    );
  }
}

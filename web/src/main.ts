/** The page: opens the bundle beside it (or within it) and connects the walk with buttons, keys and messages. */

import { addressOf, parseAddress } from './address';
import { kIndexName } from './bundle/read_index';
import { threadsOfDevice } from './device';
import { reportOfFirstFrame } from './first_frame';
import { openWalk, type OpenWalk } from './open_walk';
import { sourceFor } from './page_source';
import { keepSettings, loadSettings, type Settings } from './settings';
import { Controls } from './ui/controls';
import { Embedding } from './ui/embed';
import { Minimap } from './ui/minimap';
import { Messages } from './ui/messages';
import { element, SettingsPanel } from './ui/panel';
import { Walk } from './walk';

const canvas = element<HTMLCanvasElement>('view');
const messages = new Messages(element('messages'));

function openGraphics(): WebGL2RenderingContext {
  const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, stencil: false, powerPreference: 'high-performance' });
  if (!gl)
    throw new Error(
      'This browser shows no WebGL2, which the walk is drawn with. Try a current Firefox, Chrome, Edge or Safari, or turn on ' +
        'hardware acceleration in its settings.',
    );
  return gl;
}

class Page {
  private readonly walk: Walk;
  private readonly panel: SettingsPanel;
  private readonly embedding: Embedding;
  private unbakedTold = 0;
  private reported = false;
  private readonly map = new Minimap(element('plan'), element('legend'));

  constructor(opened: OpenWalk, settings: Settings, gl: WebGL2RenderingContext) {
    const { bundle } = opened;
    const controls: Controls = new Controls(
      canvas, (dx, dy) => this.walk.look(dx, dy), () => this.walk.wake(), (key) => this.command(key, controls),
    );
    this.walk = new Walk(canvas, gl, opened, settings, () => controls.takeMovement(), {
      drawn: () => this.drawn(),
      failed: () => this.failed(),
      stopped: () => this.keepAddress(),
    });
    this.panel = new SettingsPanel(this.walk, () => {
      keepSettings(settings);
      this.walk.settingsChanged();
      this.showToggles();
    });
    this.embedding = new Embedding(this.walk);
    this.connectTools();
    this.showToggles();
    document.title = `${bundle.name} – walk`;
    element('name').textContent = bundle.name;
    canvas.setAttribute('aria-label', `The walk through ${bundle.name}`);
    if (!this.walk.canFill) messages.show('fill', 'This browser cannot draw into floating-point pictures: holes stay black.');
    this.goToAddress();
    window.addEventListener('hashchange', () => this.goToAddress());
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.walk.contextLost();
      messages.show('lost', 'The browser took the graphics card away. The walk goes on when it gives it back …');
    });
    canvas.addEventListener('webglcontextrestored', () => {
      messages.hide('lost');
      this.walk.contextRestored();
    });
    Object.assign(window, { acentric: this.walk });
  }

  private goToAddress(): void {
    const { bundle } = this.walk;
    const address = parseAddress(location.hash, bundle.storeys.length, bundle.storey);
    if (address) this.walk.go({ eye: [...address.eye, 0], yaw: address.yaw, pitch: address.pitch }, address.storey);
  }

  /** So that a reload, or a copied address, shows the same view. */
  private keepAddress(): void {
    const { bundle, pose, storey } = this.walk;
    try {
      history.replaceState(null, '', addressOf(pose.eye, pose.yaw, pose.pitch, storey, bundle.storey));
    } catch {
      // Some browsers refuse it to pages within pages, or when it comes too often.
    }
  }

  private command(key: string, controls: Controls): boolean {
    const buttons: { [key: string]: string } = { m: 'tool-map', h: 'tool-holes', o: 'tool-settings', '?': 'tool-help' };
    const button = buttons[key.toLowerCase()];
    if (button) element(button).click();
    else if (key.toLowerCase() === 'l') controls.lockPointer();
    else if (key === 'Home') this.walk.go(this.walk.startPose());
    else if (key === 'Escape') this.closePanels();
    else return false;
    return true;
  }

  private connectTools(): void {
    const { settings } = this.walk;
    const toggle = (name: 'map' | 'holes') =>
      element(`tool-${name}`).addEventListener('click', () => {
        settings[name] = !settings[name];
        keepSettings(settings);
        this.showToggles();
        this.walk.redraw();
      });
    toggle('map');
    toggle('holes');
    for (const name of ['settings', 'help'])
      element(`tool-${name}`).addEventListener('click', () => {
        const open = element(name).hidden;
        this.closePanels();
        element(name).hidden = !open;
        element(`tool-${name}`).setAttribute('aria-expanded', String(open));
        if (open) element(name).querySelector<HTMLElement>('select, input')?.focus();
      });
  }

  private closePanels(): void {
    for (const name of ['settings', 'help']) {
      if (element(name).contains(document.activeElement)) element(`tool-${name}`).focus();
      element(name).hidden = true;
      element(`tool-${name}`).setAttribute('aria-expanded', 'false');
    }
  }

  private showToggles(): void {
    const { settings } = this.walk;
    for (const name of ['map', 'holes'] as const) element(`tool-${name}`).setAttribute('aria-pressed', String(settings[name]));
    element('map').hidden = !settings.map;
    this.drawn();
  }

  private drawn(): void {
    const { walk } = this, { facts, pose } = walk;
    const region = walk.region;
    const storey = walk.bundle.storeys.length > 1 ? `${walk.current.name}, ` : '';
    element('place').textContent = `${storey}region ${region < 0 ? 'outside' : walk.current.regions[region].number + 1} of ${walk.current.regionCount}` + (walk.loading > 0 ? ', loading …' : '');
    const times = walk.times.summary;
    if (times)
      element('times').textContent =
        `${times.median.toFixed(0)} ms a frame, worst ${times.worst.toFixed(0)} · ${facts.patches.toLocaleString('en')} patches`;
    if (walk.settings.map) {
      const view = walk.view();
      this.map.draw(walk.current, walk.regions.box, {
        eye: [pose.eye[0], pose.eye[1]], yaw: pose.yaw, fov: 2 * Math.atan((0.5 * view.width) / view.focal),
        region, captures: facts.captures, isFull: walk.isFull,
      });
    }
    this.tellUnbaked();
    this.reportFirstFrame();
    this.embedding.drawn();
    this.panel.show();
  }

  private reportFirstFrame(): void {
    const { firstPicture } = this.walk;
    if (this.reported || firstPicture === undefined) return;
    this.reported = true;
    const report = reportOfFirstFrame(location.search, firstPicture);
    if (report) void fetch(report).catch(() => undefined);
  }

  private tellUnbaked(): void {
    const { unbaked } = this.walk;
    if (unbaked === this.unbakedTold) return;
    this.unbakedTold = unbaked;
    if (unbaked === 0) return messages.hide('unbaked');
    messages.show('unbaked', `${unbaked === 1 ? 'A capture' : `${unbaked} captures`} of this place ${unbaked === 1 ? 'was' : 'were'} not baked: parts of it stay empty.`);
  }

  private failed(): void {
    const failures = [...this.walk.failures.values()];
    if (failures.length === 0) return messages.hide('files');
    const [first] = failures;
    const more = failures.length > 1 ? ` (and ${failures.length - 1} more files)` : '';
    const instead = first.file.startsWith('captures/') ? ' Its coarse capture stands in.' : '';
    messages.show('files', `${first.file}: ${first.reason}.${instead}${more}`, 'Try again', () => {
      messages.hide('files');
      this.walk.retry();
    });
  }
}

async function open(): Promise<void> {
  const source = await sourceFor(kIndexName);
  const gl = openGraphics();
  const opened = await openWalk(source, threadsOfDevice());
  new Page(opened, loadSettings((opened.bundle.fov * 180) / Math.PI), gl);
}

open().catch((error: unknown) => {
  messages.fatal(error instanceof Error ? error.message : String(error));
});

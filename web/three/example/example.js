// A walk with objects of our own before and behind what it shows. ?walk=ADDRESS: a folder of a bundle (with "/" at its end) or
// a walk of one file, beside this page; walk/ by default. W, A, S, D or arrows walk, a drag looks around.
import {
  AmbientLight, BoxGeometry, DirectionalLight, Mesh, MeshPhysicalMaterial, MeshStandardMaterial, PerspectiveCamera, Scene,
  SphereGeometry, Vector3, WebGLRenderer,
} from 'three';
import { AcentricWalk } from 'acentric-three';

const status = document.getElementById('status');
const renderer = new WebGLRenderer({ antialias: true });
document.body.prepend(renderer.domElement);
const camera = new PerspectiveCamera(50, 1, 0.05, 200);
camera.rotation.order = 'YXZ'; // turn, then look up or down
const scene = new Scene();
const sun = new DirectionalLight(0xfff4e0, 2);
sun.position.set(-1, 3, 2);
scene.add(new AmbientLight(0xffffff, 1.2), sun);

// Drawn is when something has changed: the walk says when something of it has come.
let asked = false;
function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame((now) => {
    asked = false;
    move(now);
    renderer.render(scene, camera);
    const { region, loading, bytes } = walk.stats;
    status.textContent = region < 0 ? 'Outside of the walk' : `${walk.name}: region ${region + 1}, ${(bytes / 1e6).toFixed(1)} MB` + (loading > 0 ? ', loading …' : '');
  });
}

const address = new URLSearchParams(location.search).get('walk') ?? 'walk/';
const walk = await AcentricWalk.open(address, renderer).catch((error) => {
  status.textContent = error.message;
  throw error;
});
walk.addEventListener('change', draw);
walk.addEventListener('error', ({ file, reason }) => console.warn(`${file}: ${reason}`));
scene.add(walk);

const { position, target } = walk.start();
camera.position.copy(position);
camera.lookAt(target);

/** So many metres ahead of where the walk begins, to its left, and above the eye. */
const place = (ahead, left, up) => {
  const forward = target.clone().sub(position), aside = new Vector3(0, 1, 0).cross(forward);
  return position.clone().addScaledVector(forward, ahead).addScaledVector(aside, left).add(new Vector3(0, up, 0));
};
function object(name, geometry, material, at) {
  const mesh = new Mesh(geometry, material);
  mesh.name = name;
  mesh.position.copy(at);
  scene.add(mesh);
  return mesh;
}
object('before', new BoxGeometry(0.3, 0.3, 0.3), new MeshStandardMaterial({ color: 0xd02818 }), place(1.5, 0.55, -0.3));
object('behind', new BoxGeometry(2, 2, 2), new MeshStandardMaterial({ color: 0x1838d0 }), place(14, -2, 0));
object('glass', new SphereGeometry(0.25, 48, 32), new MeshPhysicalMaterial({ transmission: 1, roughness: 0, ior: 1.4, thickness: 0.3 }), place(1.6, -0.5, -0.1));

const kMetresPerSecond = 1.4, kRadiansPerSecond = 1.4;
const held = new Set();
let last;
const hold = (one, other) => (held.has(one) ? 1 : 0) - (held.has(other) ? 1 : 0);

/** By the keys that are held, and on as long as any is. */
function move(now) {
  const seconds = last === undefined ? 1 / 60 : Math.min(0.1, (now - last) / 1000);
  last = held.size > 0 ? now : undefined;
  if (held.size === 0) return;
  camera.rotation.y += hold('ArrowLeft', 'ArrowRight') * kRadiansPerSecond * seconds;
  const ahead = Math.sign(hold('KeyW', 'KeyS') + hold('ArrowUp', 'ArrowDown')), aside = hold('KeyD', 'KeyA');
  const step = new Vector3(aside, 0, -ahead).applyAxisAngle(new Vector3(0, 1, 0), camera.rotation.y);
  if (step.lengthSq() > 0) {
    const from = camera.position.clone();
    walk.moveWithin(from, camera.position.addScaledVector(step.normalize(), kMetresPerSecond * seconds));
  }
  draw();
}
addEventListener('keydown', ({ code }) => {
  if (!/^(Key[WASD]|Arrow(Up|Down|Left|Right))$/.test(code)) return;
  held.add(code);
  draw();
});
addEventListener('keyup', ({ code }) => held.delete(code));
addEventListener('blur', () => held.clear());
renderer.domElement.addEventListener('pointermove', ({ buttons, movementX, movementY }) => {
  if (buttons === 0) return;
  const radians = ((camera.fov * Math.PI) / 180) / innerHeight;
  camera.rotation.y += movementX * radians;
  camera.rotation.x = Math.max(-1.4, Math.min(1.4, camera.rotation.x + movementY * radians));
  draw();
});

function resize() {
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  draw();
}
addEventListener('resize', resize);
resize();
Object.assign(window, { renderer, scene, camera, walk }); // for the console

// The drawing of the spacecraft: hub, joints with their bodies, and two vectors, as objects of three.js.

import {
  BoxGeometry, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DirectionalLight, EdgesGeometry,
  Float32BufferAttribute, Group, HemisphereLight, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, Quaternion, Scene, SphereGeometry, TorusGeometry, Vector3,
} from 'three';
import { BODIES } from './palette.js';

const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

function solid(colour) {
  return new MeshLambertMaterial({ color: colour });
}

/** The rotation that takes y, the axis of a cylinder, or z, the normal of a torus, to a direction. */
function aim(object, from, direction) {
  object.quaternion.setFromUnitVectors(AXES[from], direction);
  return object;
}

/** A row-major rotation as a quaternion. */
function rotation(m) {
  const matrix = new Matrix4().set(m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, 0, 0, 0, 1);
  return new Quaternion().setFromRotationMatrix(matrix);
}

/** Lines from pairs of points. */
function lines(points, material) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, material);
}

/** A disc with spokes, so that its turning is seen. */
function wheel(body, axis, outline) {
  const group = new Group();
  const { radius, width } = body;
  const disc = new CylinderGeometry(radius, radius, width, 48);
  group.add(new Mesh(disc, solid(BODIES.wheel)), new LineSegments(new EdgesGeometry(disc, 30), outline));
  const spokes = [];
  for (const side of [-1, 1]) {
    const y = side * (width / 2) * 1.01;
    for (let k = 0; k < 6; k += 1) {
      const angle = (k * Math.PI) / 3;
      spokes.push(0, y, 0, radius * Math.cos(angle), y, radius * Math.sin(angle));
    }
  }
  group.add(lines(spokes, outline));
  return aim(group, 1, AXES[axis]);
}

/** A gimbal's ring with its two trunnions on the joint's axis. `normal` is that of the ring's plane. */
function ring(body, axis, normal) {
  const group = new Group();
  const tube = Math.min(Math.max(body.width / 2, body.radius * 0.03), body.radius * 0.12);
  const material = solid(BODIES.ring);
  group.add(aim(new Mesh(new TorusGeometry(body.radius, tube, 12, 64), material), 2, normal));
  for (const side of [-1, 1]) {
    const stub = new Mesh(new CylinderGeometry(tube, tube, body.radius * 0.3, 16), material);
    stub.position.copy(AXES[axis]).multiplyScalar(side * body.radius * 1.15);
    group.add(aim(stub, 1, AXES[axis]));
  }
  return group;
}

function plate(body, outline) {
  const group = new Group();
  const box = new BoxGeometry(...body.size);
  group.add(new Mesh(box, solid(BODIES.plate)), new LineSegments(new EdgesGeometry(box), outline));
  return group;
}

/** The plane of a gimbal's ring holds its own axis and that of the joint it carries. */
function ringNormal(joints, index) {
  const own = AXES[joints[index].axis];
  const child = joints.find((joint) => joint.parent === index);
  if (child !== undefined) {
    const axis = AXES[child.axis].clone().applyQuaternion(rotation(child.mount));
    const normal = axis.cross(own);
    if (normal.length() > 1e-3) return normal.normalize();
  }
  return AXES[(joints[index].axis + 1) % 3].clone();
}

function bodyOf(joints, index, outline) {
  const { body, axis } = joints[index];
  const group = new Group();
  if (!body) return group;
  group.position.set(...(body.centre ?? [0, 0, 0]));
  if (body.shape === 'wheel') group.add(wheel(body, axis, outline));
  if (body.shape === 'ring') group.add(ring(body, axis, ringNormal(joints, index)));
  if (body.shape === 'plate') group.add(plate(body, outline));
  if (body.shape === 'ball') group.add(new Mesh(new SphereGeometry(body.radius, 32, 16), solid(BODIES.ball)));
  if (body.heavy) {
    const reach = body.shape === 'plate' ? Math.max(...body.size) / 2 : body.radius;
    const size = Math.max(0.15 * reach, 0.75 * (body.width ?? 0));
    const spot = new Mesh(new SphereGeometry(size, 24, 12), solid(BODIES.heavy));
    spot.position.set(...body.heavy).normalize().multiplyScalar(0.82 * reach);
    group.add(spot);
  }
  return group;
}

/** An arrow along y, one unit long, whose thickness does not change with its length. */
function arrow(colour, thickness) {
  const material = new MeshBasicMaterial({ color: colour });
  const shaft = new Mesh(new CylinderGeometry(thickness, thickness, 1, 16), material);
  const head = new Mesh(new ConeGeometry(3 * thickness, 8 * thickness, 20), material);
  const group = new Group();
  group.add(shaft, head);
  return {
    group,
    point(direction, length) {
      const tip = 8 * thickness;
      group.visible = length > tip;
      if (!group.visible) return;
      shaft.scale.y = length - tip / 2;
      shaft.position.y = (length - tip / 2) / 2;
      head.position.y = length - tip / 2;
      group.quaternion.setFromUnitVectors(AXES[1], direction);
    },
  };
}

/** Everything that is drawn. `reach` is the radius that holds the spacecraft. */
export function createScene(replay) {
  const scene = new Scene();
  const outline = new LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.75 });
  const hub = new Group();
  scene.add(hub, new HemisphereLight(0xffffff, 0x9098a8, 2.2));
  const sun = new DirectionalLight(0xffffff, 1.6);
  sun.position.set(2, -3, 4);
  scene.add(sun);

  const centre = new Vector3(...replay.hub.centre);
  const box = new BoxGeometry(...replay.hub.size);
  const walls = new MeshLambertMaterial({ color: BODIES.hub, transparent: true, opacity: 0.28, depthWrite: false });
  for (const object of [new Mesh(box, walls), new LineSegments(new EdgesGeometry(box), outline)]) {
    object.position.copy(centre);
    hub.add(object);
  }

  // Each joint: its frame at zero angle, and in it the frame that turns or slides.
  const moving = replay.joints.map((joint, index) => {
    const inner = new Group();
    inner.add(bodyOf(replay.joints, index, outline));
    return inner;
  });
  replay.joints.forEach((joint, index) => {
    const fixed = new Group();
    fixed.position.set(...joint.origin);
    fixed.quaternion.copy(rotation(joint.mount));
    fixed.add(moving[index]);
    (joint.parent < 0 ? hub : moving[joint.parent]).add(fixed);
  });

  // The radius of a ball about B that holds all bodies at zero coordinates.
  let reach = centre.length() + new Vector3(...replay.hub.size).length() / 2;
  hub.updateMatrixWorld(true);
  replay.joints.forEach(({ body }, index) => {
    if (!body) return;
    const at = new Vector3(...(body.centre ?? [0, 0, 0])).applyMatrix4(moving[index].matrixWorld);
    const extent = body.shape === 'plate' ? new Vector3(...body.size).length() / 2 : body.radius;
    reach = Math.max(reach, at.length() + extent);
  });
  const half = new Vector3(...replay.hub.size).length() / 2;
  const longest = Math.max(1.5 * half, 0.7 * reach);
  const momentum = arrow(BODIES.momentum, longest * 0.012);
  const omega = arrow(BODIES.omega, longest * 0.012);
  scene.add(momentum.group, omega.group);

  return {
    scene,
    reach: Math.max(reach, longest),
    longest,
    setInk(colour) {
      outline.color = new Color(colour);
    },
    /** Puts everything where a state of the motion has it; metres per unit for both vectors. */
    show(state, perMomentum, perOmega) {
      const [q0, q1, q2, q3] = state.shown;
      hub.quaternion.set(q1, q2, q3, q0);
      replay.joints.forEach((joint, index) => {
        const value = state.joint[index];
        if (joint.slides) moving[index].position.copy(AXES[joint.axis]).multiplyScalar(value);
        else moving[index].quaternion.setFromAxisAngle(AXES[joint.axis], value);
      });
      const h = new Vector3(...state.momentum);
      const w = new Vector3(...state.omega);
      w.applyQuaternion(new Quaternion(state.real[1], state.real[2], state.real[3], state.real[0]));
      const [lengthH, lengthW] = [h.length(), w.length()];
      momentum.point(h.normalize(), lengthH * perMomentum);
      omega.point(w.normalize(), lengthW * perOmega);
    },
  };
}

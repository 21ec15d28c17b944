// The pane of three.html as a component of react-three-fiber: a touch breaks it, another one brings a new pane.
import { Suspense, use, useMemo, useRef, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { Canvas, useFrame } from '@react-three/fiber';
import { DoubleSide, Quaternion, Vector3 } from 'three';
import { Breakable } from 'frangible';
import { bufferGeometry } from 'frangible/three';

const loading = Breakable.load('../bodies/pane.frangible'); // a pane of glass, 4 mm thick
const ball = { mass: 0.13 };

/** A whole body or a fragment: glass outside, and another look where it cracked. */
function Solid({ solid, ...rest }) {
  const geometry = useMemo(() => bufferGeometry(solid.geometry), [solid]);
  return (
    <mesh geometry={geometry} castShadow {...rest}>
      <meshPhysicalMaterial attach="material-0" color="#9fd3c7" transparent opacity={0.45} roughness={0.05} side={DoubleSide} />
      <meshPhysicalMaterial attach="material-1" color="#2f8f77" roughness={0.3} />
    </mesh>
  );
}

function Piece({ solid, motion: { position, rotation, linear, angular }, ...rest }) {
  const piece = useRef();
  const [velocity, turn] = useMemo(() => [new Vector3(...linear), new Vector3(...angular)], [linear, angular]);
  useFrame(() => {
    const dt = 1 / 60 / 8; // eight times slower than life
    velocity.y -= 9.81 * dt;
    piece.current.position.addScaledVector(velocity, dt);
    piece.current.quaternion.premultiply(new Quaternion().setFromAxisAngle(turn.clone().normalize(), turn.length() * dt));
  });
  return <group ref={piece} position={position} quaternion={rotation}><Solid solid={solid} {...rest} /></group>;
}

function Pane({ seed, position }) {
  const kind = use(loading);
  const [broken, setBroken] = useState();
  useFrame(() => (globalThis.drawn = (globalThis.drawn ?? 0) + 1));
  const strike = ({ point, face }) => {
    const normal = face.normal.clone().negate();
    const pose = { position, rotation: [0, 0, 0, 1] };
    const outcome = kind.body(seed).impact({ point, normal, speed: 12, striker: ball }, { pose });
    if (!outcome.broke) return;
    const striker = { ...ball, position: point, linear: normal.multiplyScalar(12) };
    setBroken({ outcome, motions: outcome.motions({ pose, striker }) });
    globalThis.pieces = outcome.fragments.length;
  };
  if (!broken) return <Solid solid={kind} position={position} onPointerDown={strike} />;
  const renew = () => setBroken(undefined);
  return broken.outcome.fragments.map((solid, i) => <Piece key={i} solid={solid} motion={broken.motions.fragments[i]} onPointerDown={renew} />);
}

createRoot(document.body).render(
  <Canvas shadows camera={{ position: [0.45, 0.3, 0.6], fov: 40, near: 0.01 }} onCreated={({ camera }) => camera.lookAt(0, 0.12, 0)}>
    <color attach="background" args={['#d8dde3']} /><hemisphereLight args={['white', '#8899aa', 1.5]} />
    <directionalLight position={[1, 2, 1.5]} intensity={3} castShadow />
    <mesh rotation-x={-Math.PI / 2} receiveShadow><planeGeometry args={[60, 60]} /><meshStandardMaterial color="#c9b79c" /></mesh>
    <Suspense><Pane seed={3} position={[0, 0.12, 0]} /></Suspense>
  </Canvas>,
);

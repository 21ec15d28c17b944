// Light, camera and a floor for the examples.
import * as THREE from 'three';

export function stage() {
  const renderer = new THREE.WebGLRenderer({ antialias: true });
  renderer.shadowMap.enabled = true;
  document.body.append(renderer.domElement);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color('#d8dde3');
  scene.fog = new THREE.Fog(scene.background, 1, 5);
  const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 10);
  camera.position.set(0.45, 0.3, 0.6);
  camera.lookAt(0, 0.12, 0);
  const sun = new THREE.DirectionalLight('white', 3);
  sun.position.set(1, 2, 1.5);
  sun.castShadow = true;
  Object.assign(sun.shadow.camera, { left: -0.6, right: 0.6, top: 0.6, bottom: -0.6 });
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(60, 60).rotateX(-Math.PI / 2), new THREE.MeshStandardMaterial({ color: '#c9b79c' }));
  floor.receiveShadow = true;
  scene.add(sun, floor, new THREE.HemisphereLight('white', '#8899aa', 1.5));
  scene.addEventListener('childadded', ({ child }) => (child.castShadow = child.isMesh && child !== floor));
  const glass = new THREE.MeshPhysicalMaterial({ color: '#9fd3c7', transparent: true, opacity: 0.45, roughness: 0.05, side: THREE.DoubleSide });
  const edge = new THREE.MeshPhysicalMaterial({ color: '#2f8f77', roughness: 0.3 });
  const draw = (step) => renderer.setAnimationLoop(() => {
    step();
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    renderer.render(scene, camera);
    globalThis.drawn = (globalThis.drawn ?? 0) + 1;
  });
  return { scene, camera, canvas: renderer.domElement, glass, edge, draw };
}

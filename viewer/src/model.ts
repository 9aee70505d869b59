// The boundary as a model in a GLB file: x, y and the angle times the robot's radius upwards, as `cfree boundary --mesh` has it.
import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardMaterial, Scene } from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";

export interface Shown {
  geometry: BufferGeometry;
  triangles: Uint32Array;
  x: number;
  y: number;
  radius: number;
}

export async function model_of(shown: Shown | undefined): Promise<ArrayBuffer | undefined> {
  if (!shown) return undefined;
  const from = shown.geometry.attributes.position!;
  const position = new Float32Array(3 * from.count);
  const geometry = new BufferGeometry();
  for (let k = 0; k < from.count; ++k)
    position.set([from.getX(k) + shown.x, from.getY(k) + shown.y, (from.getZ(k) + Math.PI / 2) * shown.radius], 3 * k);
  geometry.setAttribute("position", new BufferAttribute(position, 3));
  geometry.setAttribute("normal", shown.geometry.attributes.normal!.clone());
  geometry.setAttribute("color", shown.geometry.attributes.color!.clone());
  geometry.setIndex(new BufferAttribute(shown.triangles, 1));
  const scene = new Scene();
  scene.add(new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true, side: DoubleSide, roughness: 0.7 })));
  return (await new GLTFExporter().parseAsync(scene, { binary: true })) as ArrayBuffer;
}

// Files that are opened: scenes, and plain SVG; of others the command that makes a scene of them.
import { scene_of_svg, type Drawing } from "./svg";

const MOST_MEGABYTES = 16;
// Endings of files that `cfree convert` reads, and what it needs beside them.
const ROBOT = " --robot robot.json";
const READ_ELSEWHERE: Record<string, string> = {
  svgz: "",
  dxf: ROBOT,
  geojson: "",
  wkt: ROBOT,
  yaml: ROBOT,
  yml: ROBOT,
  map: ROBOT,
};
// An image or a drawing of another program is converted before.
const OTHERS: Record<string, string> = {
  dwg: "save it as DXF in the program that drew it",
  pgm: "open the YAML file that describes the map",
  png: "open the YAML file that describes the map",
  pdf: "save it as SVG",
};

// A scene's text, and what of the file it lacks. Throws an error with the remedy.
export async function read_file(file: File): Promise<Drawing> {
  const name = file.name.slice(-80);
  if (file.size > MOST_MEGABYTES << 20)
    throw new Error(`${name}: ${(file.size / 1e6).toFixed(0)} MB; this page reads ${MOST_MEGABYTES}.`);
  const ending = /\.(\w+)$/.exec(name)?.[1]!.toLowerCase() ?? "";
  const options = READ_ELSEWHERE[ending];
  if (options !== undefined)
    throw new Error(
      `${name}: the page reads scenes and plain SVG. Make a scene of it: \`cfree convert ${name} scene.json${options}\``,
    );
  const other = OTHERS[ending];
  if (other) throw new Error(`${name}: the page reads scenes and plain SVG; ${other}, then \`cfree convert\`.`);
  const text = await file.text();
  const is_drawing =
    ending === "svg" || /^\s*(<\?xml[^>]*>\s*)?(<!--[^]*?-->\s*)*(<!DOCTYPE[^>]*>\s*)?<svg[\s>]/.test(text);
  return is_drawing ? scene_of_svg(text, name) : { source: text, left_out: "" };
}

// The page in a notebook's cell: a frame of its own, which cannot reach the notebook, and messages between it and the model.
const TRAITS = { scene: "source", robot: "robot", start: "start", goal: "goal", vehicle: "vehicle", poses: "poses" };

function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.title = "Robot, obstacles and configuration space";
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  frame.style.cssText = "width:100%;box-sizing:border-box;border:1px solid #8884;border-radius:10px;display:block";
  let is_heard = false, due = 0, saving = 0;
  let driver; // the vehicle of the path that the page has shown last, as text

  const show = () => {
    const values = Object.entries(TRAITS).map(([name, trait]) => [name, model.get(trait)]);
    const given = Object.fromEntries(values.filter(([, value]) => value));
    const poses = given.poses?.split("\n"), is_at = (end, pose) => end && pose === `${end.x} ${end.y} ${end.tau}`;
    given.vehicle = model.get("vehicle"); // null is any direction, whatever the scene has
    const is_driven = driver === undefined || driver === JSON.stringify(given.vehicle);
    if (poses && !(is_driven && is_at(given.start, poses[0]) && is_at(given.goal, poses.at(-1)))) delete given.poses; // of an older question
    frame.contentWindow?.postMessage({ cfree: "show", given }, "*");
  };
  const hear = ({ source, data }) => {
    if (!source || source !== frame.contentWindow) return;
    if (data?.cfree === "ready") show();
    if (data?.cfree !== "seen") return;
    is_heard = true;
    driver = JSON.stringify(data.seen.vehicle);
    for (const [name, trait] of Object.entries(TRAITS)) model.set(trait, data.seen[name] ?? null);
    is_heard = false;
    saving ||= setTimeout(save, 100); // ten times a second while something is dragged
  };
  const save = () => { saving = 0, model.save_changes(); };
  const changed = () => {  // by Python; several traits at once are shown at once
    if (is_heard) return;
    clearTimeout(due);
    due = setTimeout(show, 0);
  };
  const resize = () => { frame.style.height = `${model.get("height")}px`; };

  const events = [...Object.values(TRAITS).map((trait) => [`change:${trait}`, changed]), ["change:height", resize]];
  for (const [event, call] of events) model.on(event, call);
  window.addEventListener("message", hear);
  resize();
  frame.srcdoc = model.get("page");
  el.append(frame);
  return () => {
    clearTimeout(due);
    if (saving) clearTimeout(saving), save();
    window.removeEventListener("message", hear);
    for (const [event, call] of events) model.off(event, call);
    frame.remove();
  };
}

export default { render };

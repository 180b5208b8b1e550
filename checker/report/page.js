// Tables that are sorted by their captions and filtered by what is typed; without this script they are read as they are.
for (const holder of document.querySelectorAll(".missions")) {
  const body = holder.querySelector("tbody"), rows = [...body.rows], count = holder.querySelector("output");
  const field = holder.querySelector("input"), choice = holder.querySelector("select");
  const show = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean), wanted = choice.value;
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !(words.every(word => text.includes(word)) && (!wanted || row.dataset.verdict === wanted));
      shown += !row.hidden;
    }
    count.textContent = `${shown} of ${rows.length}`;
  };
  field.addEventListener("input", show);
  choice.addEventListener("change", show);
  holder.querySelector(".controls").hidden = false;
  show();
  const buttons = [...holder.querySelectorAll("th button")];
  buttons.forEach((button, column) => button.addEventListener("click", () => {
    const rising = button.parentElement.getAttribute("aria-sort") !== "ascending";
    for (const other of buttons) other.parentElement.removeAttribute("aria-sort");
    button.parentElement.setAttribute("aria-sort", rising ? "ascending" : "descending");
    const key = row => { const text = row.cells[column].textContent.trim(), value = Number(text);
      return text === "" ? -Infinity : Number.isNaN(value) ? text : value; };
    const order = (a, b) => { const x = key(a), y = key(b);
      return typeof x === typeof y ? (x < y ? -1 : x > y ? 1 : 0) : typeof x === "number" ? -1 : 1; };
    rows.sort((a, b) => rising ? order(a, b) : order(b, a));
    body.append(...rows);
  }));
}

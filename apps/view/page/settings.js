// SPDX-License-Identifier: BSD-3-Clause
// The settings that may change while the program runs.

/**
 * Shows them as a table of fields; a field that somebody is writing into is left alone.
 * @param settings [{number, name, value, min, max, whole, unit, meaning}]
 * @param changed(number, value) What somebody has entered; the server answers with what then holds.
 */
export function showSettings(table, settings, changed) {
  for (const setting of settings) {
    const input = table.querySelector(`input[name="${setting.name}"]`) ?? addRow(table, setting);
    input.onchange = () => {
      if (input.validity.valid) changed(setting.number, input.valueAsNumber);
    };
    // What is not valid was never sent: whoever wrote it goes on writing.
    if (document.activeElement !== input || input.validity.valid) input.value = shortest(setting);
  }
}

function addRow(table, setting) {
  const row = table.insertRow();
  row.title = setting.meaning;
  const label = document.createElement('label');
  label.textContent = setting.name;
  label.htmlFor = `setting-${setting.name}`;
  const input = document.createElement('input');
  Object.assign(input, {
    id: label.htmlFor, name: setting.name, type: 'number', required: true,
    min: setting.min, max: setting.max, step: setting.whole ? 1 : 'any',
  });
  row.insertCell().append(label);
  row.insertCell().append(input);
  row.insertCell().textContent = setting.unit;
  return input;
}

/** The server's values are floats: 0.1 comes as 0.10000000149. */
const shortest = ({ value }) => String(Number(value.toPrecision(7)));

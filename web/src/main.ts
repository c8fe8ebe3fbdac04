// The page: choose a domain, see its mesh in numbers and its certificate.
import { DualblockError } from '../../wasm/io/errors.ts';
import { makeReport } from '../../wasm/report.ts';
import { defaultSettings, inputFormats } from '../../wasm/settings.ts';
import { CoreClient } from './core-client.ts';
import { element } from './element.ts';
import { showReport } from './report-view.ts';

interface Example {
  name: string;
  title: string;
  figure: string;
  dimension: 2 | 3;
}

const firstExample = 'square_ring';
const core = new CoreClient();
const select = element('example', HTMLSelectElement);
const file = element('file', HTMLInputElement);
const status = element('status');
const running = element('running');
const progress = element('progress', HTMLProgressElement);
const stage = element('stage');
const error = element('error');

let latest = 0;

/** Ends what is under way. Returns a number that stays `latest` until the next call. */
function interrupt(): number {
  core.cancel();
  running.hidden = true;
  return ++latest;
}

/** Runs a domain and shows it, unless another one is asked for meanwhile; what was shown before stays if that fails. */
async function show(title: string, name: string, read: () => Promise<ArrayBuffer>): Promise<void> {
  const turn = interrupt();
  error.textContent = '';
  status.textContent = `Meshing ${title}…`;
  progress.value = 0;
  stage.textContent = '';
  running.hidden = false;
  try {
    const started = performance.now();
    const bytes = new Uint8Array(await read());
    if (turn !== latest) return;
    const { result, memory } = await core.run(name, bytes, {}, (name, done) => {
      progress.value = done;
      stage.textContent = name;
    });
    showReport(title, makeReport(result, defaultSettings, memory));
    status.textContent = `${title}: done in ${Math.ceil(performance.now() - started)} ms.`;
    running.hidden = true;
  } catch (problem) {
    if (turn !== latest) return;
    running.hidden = true;
    status.textContent = `${title} could not be meshed.`;
    const code = problem instanceof DualblockError ? problem.code : 'fileUnreadable';
    const message = problem instanceof Error ? problem.message : String(problem);
    error.textContent = `${message} [${code}]`;
  }
}

function showFile(chosen: File | undefined): void {
  if (!chosen) return;
  select.value = '';
  void show(chosen.name, chosen.name, () => chosen.arrayBuffer());
}

function showExample(): void {
  const { value, selectedOptions } = select;
  const name = `${value}.json`;
  void show(selectedOptions[0]?.label ?? value, name, () => fetchBytes(`examples/${name}`));
}

async function fetchBytes(path: string): Promise<ArrayBuffer> {
  const response = await fetch(new URL(path, document.baseURI));
  if (!response.ok) throw new Error(`${path} cannot be loaded (${response.status}): reload the page.`);
  return response.arrayBuffer();
}

async function listExamples(): Promise<void> {
  const text = new TextDecoder().decode(await fetchBytes('examples/index.json'));
  const { examples } = JSON.parse(text) as { examples: Example[] };
  for (const dimension of [3, 2]) {
    const group = document.createElement('optgroup');
    group.label = `${dimension}D`;
    for (const { name, title, figure } of examples.filter((e) => e.dimension === dimension))
      group.append(new Option(figure ? `${title} (${figure})` : title, name));
    select.append(group);
  }
  select.value = firstExample;
  showExample();
}

element('formats').textContent = inputFormats.map((format) => `.${format}`).join(' ');
file.accept = inputFormats.map((format) => `.${format}`).join();
select.addEventListener('change', showExample);
file.addEventListener('change', () => {
  showFile(file.files?.[0]);
  file.value = ''; // so that the same file can be chosen again
});
element('cancel').addEventListener('click', () => {
  interrupt();
  status.textContent = 'Cancelled.';
});
document.addEventListener('dragover', (event) => event.preventDefault());
document.addEventListener('drop', (event) => {
  event.preventDefault();
  showFile(event.dataTransfer?.files[0]);
});

listExamples().catch((problem: unknown) => {
  status.textContent = 'The examples could not be loaded.';
  error.textContent = String(problem);
});

// What the colours of the step mean.
import { cssColour, featurePalette, hardRed, qualityColour, softBlue, softLight } from '../scene/palette.ts';
import { Swatch } from './controls.tsx';
import { useApp, useView } from './hooks.ts';

export function Legend() {
  const app = useApp();
  const step = useView((s) => s.step);
  const flat = app.model?.result.dimension === 2;
  if (step === 1 && !app.model?.result.onlyMatching)
    return (
      <ul class="legend">
        {['End: 1 block', 'Side: 2', 'Corner: 3', 'Reversal: 4'].map((name, k) => (
          <li key={name}>
            <Swatch colour={cssColour(featurePalette[k]!)} /> {name}
          </li>
        ))}
      </ul>
    );
  if (step === 3 || step === 4)
    return (
      <ul class="legend">
        <li>
          <Swatch colour={cssColour(hardRed)} /> hard
        </li>
        <li>
          <Swatch colour={cssColour(softBlue)} second={cssColour(softLight)} /> soft,{' '}
          {flat ? 'dashed' : 'hatched'}
        </li>
      </ul>
    );
  if (step >= 8)
    return (
      <ul class="legend">
        {[0.05, 0.3, 0.55, 0.8, 1].map((q) => (
          <li key={q}>
            <Swatch colour={cssColour(qualityColour(q))} /> {q === 0.05 ? '0' : q}
          </li>
        ))}
      </ul>
    );
  return null;
}

import { quoted } from '../../ui/address.ts';
import type { Channels, StateOf } from './channel.ts';

/*
 * A figure's state as one line of text, which pages put into their address: "v1&fig-9" is a preset, and "v1&from=fig-9&power=3" one that was
 * changed. Only what differs from the preset is written. The line begins with the version of this format; lines of before there was one,
 * without it, are read as version 1.
 */

const VERSION = 1;

/** A state that a figure can begin with. */
export interface Preset<C extends Channels> {
  readonly id: string;
  /** In the row of presets. */
  readonly name: string;
  readonly title?: string;
  /** What to look at, and what to do with it. */
  readonly look?: string;
  readonly attempt?: string;
  /** What differs from the channels' own first values. */
  readonly state: Partial<StateOf<C>>;
}

/**
 * What channels were called in texts without a version, "from" being the preset; and parts of such texts that meant a preset where none was
 * named: { 'd=2': 'plane' }.
 */
export type Former = Readonly<Record<string, string>>;

/** What follows from what a text says, named by its channels: a frame that holds its points. */
export type Mend<C extends Channels> = (state: StateOf<C>, said: ReadonlySet<string>) => StateOf<C>;

export interface ReadState<C extends Channels> {
  readonly preset: Preset<C>;
  readonly state: StateOf<C>;
  /** What the text says that could not be read, as it is to be told. */
  readonly left: readonly string[];
  /** Written by a version of this format that is newer than this one: only its preset was taken. */
  readonly newer: boolean;
}

export function stateOfPreset<C extends Channels>(channels: C, preset: Preset<C>): StateOf<C> {
  const initial = Object.entries(channels).map(([key, channel]) => [key, channel.initial]);
  return { ...Object.fromEntries(initial), ...preset.state };
}

export function toText<C extends Channels>(channels: C, preset: Preset<C>, state: StateOf<C>): string {
  const base = stateOfPreset(channels, preset);
  const changed = Object.entries(channels).flatMap(([key, channel]) => {
    const text = channel.write(state[key], state);
    return text === channel.write(base[key], base) ? [] : [`${key}=${escaped(text)}`];
  });
  return [`v${VERSION}`, ...(changed.length === 0 ? [preset.id] : [`from=${preset.id}`, ...changed])].join('&');
}

/** The state that a text says, as far as it can be read; the first preset where it says nothing. Never throws. */
export function fromText<C extends Channels>(
  channels: C,
  presets: readonly Preset<C>[],
  text: string,
  former: Former = {},
  mend: Mend<C> = (state) => state,
): ReadState<C> {
  const [first] = presets;
  if (!first) throw new Error('A figure needs a preset.');
  const parts = text.replace(/^#/, '').split('&').filter(Boolean);
  const version = Number(/^v(\d+)$/.exec(parts[0] ?? '')?.[1] ?? Number.NaN);
  if (!Number.isNaN(version)) parts.shift();
  let preset: Preset<C> | undefined;
  /** Of each part. */
  const left = parts.map((): string[] => []);
  const given = new Map<string, (readonly [part: string, text: string, left: string[]])[]>();
  for (const [i, part] of parts.entries()) {
    const lost = left[i] as string[];
    const at = part.indexOf('=');
    const [name, value] = at < 0 ? ['from', part] : [part.slice(0, at), part.slice(at + 1)];
    const key = (Number.isNaN(version) && Object.hasOwn(former, name) && former[name]) || name;
    const named = key === 'from' ? presets.find(({ id }) => id === plain(value)) : undefined;
    // No preset, perhaps a channel of that name.
    const channel = key === 'from' ? name : key;
    if (named) preset = named;
    else if (Object.hasOwn(channels, channel)) given.set(channel, [...(given.get(channel) ?? []), [part, plain(value), lost]]);
    else lost.push(quoted(plain(part)));
  }
  const said = new Set(preset ? ['from'] : []);
  const meant = Number.isNaN(version) ? parts.map((part) => former[part]) : [];
  preset ??= presets.find(({ id }) => meant.includes(id)) ?? first;
  const state: Record<string, unknown> = { ...stateOfPreset(channels, preset) };
  const newer = version > VERSION;
  if (newer) return { preset, state: state as StateOf<C>, left: [], newer };
  for (const [key, channel] of Object.entries(channels)) {
    for (const [part, value, lost] of given.get(key) ?? []) {
      const read = channel.read(value, lost, state);
      if (read === undefined) lost.push(quoted(plain(part)));
      else state[key] = read;
      if (read !== undefined) said.add(key);
    }
  }
  return { preset, state: mend(state as StateOf<C>, said), left: left.flat(), newer };
}

/** Without what separates the parts, and what ends an address. */
function escaped(text: string): string {
  return text.replace(/[%&#\s]/g, encodeURIComponent);
}

function plain(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

//! Selection of resonators: the loudest within a budget, without masked ones.

use crate::voice::Voice;

/// Critical bands of the ear.
const BANDS: usize = 25;

/// A tone this far below all others of its critical band is not heard, as a share of their power: −50 dB. Tones of one band die
/// away about as fast as each other, so that a masked one stays so.
const MASKED: f32 = 1e-5;

/// The critical band of a frequency, Hz: Traunmüller's formula (J. Acoust. Soc. Am. 88, 1990).
fn band(frequency: f64) -> usize {
    let bark = 26.81 * frequency / (1960.0 + frequency) - 0.53;
    (bark.max(0.0) as usize).min(BANDS - 1)
}

/// Numbers of resonators that a selection took out.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Taken {
    pub(crate) masked: u64,
    pub(crate) over_budget: u64,
}

/// Lets masked resonators fade, and the quietest where there are more than `budget`. `levels` is a buffer.
pub(crate) fn select(voices: &mut [Option<Voice>], budget: usize, levels: &mut Vec<f32>) -> Taken {
    let mut taken = Taken::default();
    let mut power = [0.0_f32; BANDS];
    for voice in voices.iter().flatten() {
        for (i, slot) in voice.slots.iter().enumerate() {
            let level = voice.level(i);
            power[band(voice.body.modes[slot.mode as usize].frequency)] += level * level;
        }
    }
    levels.clear();
    for voice in voices.iter_mut().flatten() {
        for i in 0..voice.slots.len() {
            let (slot, level) = (voice.slots[i], voice.level(i));
            let all = power[band(voice.body.modes[slot.mode as usize].frequency)];
            if slot.goes {
                continue;
            }
            if level * level < MASKED * all {
                voice.fade(i);
                taken.masked += 1;
            } else {
                levels.push(level);
            }
        }
    }
    if levels.len() <= budget {
        return taken;
    }
    let over = levels.len() - budget;
    let (_, &mut bar, _) = levels.select_nth_unstable_by(over - 1, f32::total_cmp);
    // Of equally loud ones the last are dropped.
    let below = levels.iter().filter(|&&level| level < bar).count();
    let (ties, mut at_bar) = (over - below, levels.iter().filter(|&&l| l == bar).count());
    for voice in voices.iter_mut().flatten() {
        for i in 0..voice.slots.len() {
            let level = voice.level(i);
            if voice.slots[i].goes || level > bar {
                continue;
            }
            if level == bar {
                at_bar -= 1;
            }
            if level < bar || at_bar < ties {
                voice.fade(i);
                taken.over_budget += 1;
            }
        }
    }
    taken
}

//! Resonators side by side: z ← e^{λT} z, and the sound is Re(G z).
//!
//! Each is a rotation that shrinks, exact for any step, and needs four products per sample, with two more for its sound. Eight
//! go side by side in the widest vectors that the processor has; operations and their order are the same on all.

/// Number of samples computed at once. An event passed to a [`Synth`](crate::Synth) at least one block ahead starts at its exact
/// sample; a later one may be delayed by up to a block.
pub const BLOCK: usize = 128;

/// Resonators side by side.
pub(crate) const LANES: usize = 8;

/// A block of samples, one sum per lane.
pub(crate) type Sums = [[f32; LANES]; BLOCK];

/// Eight resonators.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Lanes {
    /// z, m√kg/s.
    pub(crate) re: [f32; LANES],
    pub(crate) im: [f32; LANES],
    /// e^{λT}.
    pub(crate) turn_re: [f32; LANES],
    pub(crate) turn_im: [f32; LANES],
    /// G at the beginning of the block, Pa√kg·s/m, and how much it changes with each sample.
    pub(crate) gain_re: [f32; LANES],
    pub(crate) gain_im: [f32; LANES],
    pub(crate) ramp_re: [f32; LANES],
    pub(crate) ramp_im: [f32; LANES],
}

frangible::widest! {
    /// Lets resonators ring for a block, and adds their sound.
    pub(crate) fn ring_block(lanes: &mut [Lanes], sums: &mut Sums) {
        for lanes in lanes {
            if lanes.ramp_re == [0.0; LANES] && lanes.ramp_im == [0.0; LANES] {
                ring::<false>(lanes, sums);
            } else {
                ring::<true>(lanes, sums);
            }
        }
    }
}

#[inline(always)]
fn ring<const RAMPS: bool>(lanes: &mut Lanes, sums: &mut Sums) {
    let Lanes {
        mut re,
        mut im,
        turn_re,
        turn_im,
        mut gain_re,
        mut gain_im,
        ramp_re,
        ramp_im,
    } = *lanes;
    for sum in sums.iter_mut() {
        for i in 0..LANES {
            let new = turn_re[i] * re[i] - turn_im[i] * im[i];
            im[i] = turn_re[i] * im[i] + turn_im[i] * re[i];
            re[i] = new;
            if RAMPS {
                gain_re[i] += ramp_re[i];
                gain_im[i] += ramp_im[i];
            }
            sum[i] += gain_re[i] * re[i] - gain_im[i] * im[i];
        }
    }
    (lanes.re, lanes.im) = (re, im);
    (lanes.gain_re, lanes.gain_im) = (gain_re, gain_im);
}

/// The sums of all lanes, in a fixed order.
pub(crate) fn total(sum: &[f32; LANES]) -> f32 {
    let [a, b, c, d, e, f, g, h] = *sum;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

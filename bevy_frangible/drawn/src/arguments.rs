//! The arguments that all examples have.

use std::path::PathBuf;

/// Options from the command line.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Arguments {
    /// The file of a picture that is to be drawn without a window.
    pub(crate) picture: Option<PathBuf>,
    /// Steps before it is drawn.
    pub(crate) steps: Option<u32>,
    /// If true, weak points and the last contacts are drawn.
    pub(crate) gizmos: bool,
}

impl Arguments {
    /// # Errors
    /// The argument that is not understood, and the ones that are.
    pub(crate) fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut read = Self::default();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--picture" => {
                    let file = words
                        .next()
                        .ok_or("--picture needs a file, such as glass.png")?;
                    read.picture = Some(file.into());
                }
                "--steps" => {
                    let steps = words.next().and_then(|steps| steps.parse().ok());
                    read.steps = Some(steps.ok_or("--steps needs a number of steps, such as 60")?);
                }
                "--gizmos" => read.gizmos = true,
                other => {
                    return Err(format!(
                        "unknown argument `{other}`; the arguments are `--picture FILE`, `--steps N` and `--gizmos`"
                    ));
                }
            }
        }
        Ok(read)
    }
}

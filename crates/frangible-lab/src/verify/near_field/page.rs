//! The page. Every number in it was computed.

use std::fmt::Write;

use super::edges::{SHARES, wavelength_of};
use super::residual::MODES;
use super::{COLUMNS, DURATION, FORCE, NearField, StressRow, TIMES};
use crate::page::{Page, table};
use crate::plot::{Axis, Chart, Marker, Series};
use crate::verify::{VerifyError, png};

/// Size of the picture, pixels.
const SIZE: (u32, u32) = (800, 600);

impl NearField {
    /// The page; its picture is `FOLDER/hoop-stress.png`. Without timings, so that the same build writes the same page.
    ///
    /// # Errors
    /// A picture that could not be encoded.
    pub fn page(&self, folder: &str) -> Result<Page, VerifyError> {
        let mut text = String::from(
            "# The near field of a blow\n\nWritten by `frangible-lab near-field --write docs`, which computes it anew. Nothing passes or fails here; \
             the cases *Near field of a blow* and *A blow, integrated* of [verification.md](verification.md) do that.\n\n",
        );
        self.stress_text(&mut text, folder);
        self.force_text(&mut text);
        self.edges_text(&mut text);
        self.residual_text(&mut text);
        let name = "hoop-stress";
        let png = png(name, &self.chart().draw(SIZE.0, SIZE.1))?;
        Ok(Page {
            text,
            pictures: vec![(name.into(), png)],
        })
    }

    fn stress_text(&self, text: &mut String, folder: &str) {
        let head: Vec<String> = std::iter::once("hoop stress, MPa".to_string())
            .chain(
                self.stress[0]
                    .at_columns()
                    .iter()
                    .map(|(r, _)| format!("{:.1} mm", 1e3 * r)),
            )
            .collect();
        let rows: Vec<Vec<String>> = self
            .stress
            .iter()
            .map(|row| {
                let cells = row.at_columns();
                std::iter::once(row.name.clone())
                    .chain(cells.iter().map(|(_, s)| format!("{s:.1}")))
                    .collect()
            })
            .collect();
        let _ = write!(
            text,
            "## What the modes cannot see\n\nA plate of PMMA (100 × 100 × 1 mm, simply supported) is pushed in its middle by a half-sine of {FORCE:.0} N and {:.0} µs over a \
             disc of {:.2} mm radius. The table and the picture show the hoop stress of the far face in the middle of the pulse, \
             over the distance from the contact. The first row is the series of all modes of a thin plate; the others are what the run time computes from so many \
             modes of finite elements, without and with the near field of a thin plate.\n\n{}\n\
             ![Hoop stress over the distance from the contact]({folder}/hoop-stress.png)\n\n\
             The modes miss most of the stress that starts a star of cracks, and twice as many of them help little. With the near field, half as many do.\n\n",
            1e6 * DURATION,
            1e3 * self.radius,
            table(&head, &rows)
        );
    }

    fn force_text(&self, text: &mut String) {
        let mut rows: Vec<Vec<String>> = TIMES
            .iter()
            .zip(&self.force)
            .map(|(t, [found, exact])| {
                vec![
                    format!("{:.0} µs", 1e6 * t),
                    format!("{found:.1} N"),
                    format!("{exact:.1} N"),
                ]
            })
            .collect();
        rows.push(vec![
            "peak".into(),
            format!("{:.1} N", self.peak[0]),
            format!("{:.1} N", self.peak[1]),
        ]);
        let head = ["time".to_string(), "computed".into(), "Zener".into()];
        let law: Vec<Vec<String>> = self
            .restitution
            .iter()
            .map(|[l, found, exact]| {
                vec![format!("{l}"), format!("{found:.3}"), format!("{exact:.3}")]
            })
            .collect();
        let law_head = ["λ".to_string(), "computed".into(), "Zener".into()];
        let _ = write!(
            text,
            "## The force of a ball on a plate\n\nA steel ball of 4 mm hits a plate of PMMA, 200 × 200 × 1 mm, at 20 m/s. \
             The plate is wide enough that no echo comes back. Zener's plate is infinite: a dashpot of 8 √(Dμ) behind Hertz' spring.\n\n{}\n\
             Restitution of steel balls of several sizes at 1 m/s, over λ = m/(Z T), Z Zener's dashpot, T = (m/(K √v))^(2/5), K Hertz' stiffness. No coefficient \
             of restitution was given to the computation; it is an outcome.\n\n{}\n",
            table(&head, &rows),
            table(&law_head, &law)
        );
    }

    fn edges_text(&self, text: &mut String) {
        let head: Vec<String> = std::iter::once("edge".to_string())
            .chain(SHARES.iter().map(|s| format!("{s} λ_c")))
            .collect();
        let rows: Vec<Vec<String>> = self
            .edges
            .iter()
            .map(|row| {
                let cells = row.errors.iter().map(|e| format!("{:.0} %", 100.0 * e));
                std::iter::once(row.name.clone()).chain(cells).collect()
            })
            .collect();
        let _ = write!(
            text,
            "## Close to an edge\n\nThe near field is that of a wall without edges. The same ball at 20 m/s hits the plate of 100 mm at several distances from an edge, or from both edges of \
             a corner, as shares of the shortest wavelength λ_c of the modes. The table shows the largest error of the total stress around the contact, over \
             its peak. Of the supported edge ({:.1} mm, 100 modes) it is against the series of all modes with an elastic layer's far face, of a free and of a \
             held edge ({:.1} mm, 75 modes followed, 225 as residual vector) against 300 modes and their near field, which have \
             such an error of their own at half the distance. The waves of the near field are not reflected at the edge, so that closer to it than a quarter of λ_c the stress between contact and edge is of the right size \
             only.\n\n{}\n",
            1e3 * wavelength_of(100),
            1e3 * wavelength_of(75),
            table(&head, &rows)
        );
    }

    fn residual_text(&self, text: &mut String) {
        let head = [
            "peak stress over that of all modes".to_string(),
            "modes followed".into(),
            "without".into(),
            "with the residual vector".into(),
        ];
        let rows: Vec<Vec<String>> = self
            .residual
            .iter()
            .map(|row| {
                vec![
                    row.name.into(),
                    row.followed.to_string(),
                    format!("{:.3}", row.without),
                    format!("{:.3}", row.with),
                ]
            })
            .collect();
        let _ = write!(
            text,
            "## Modes that follow the force\n\nIn every body the modes that are not followed through time answer the force statically, together, as one more \
             shape: the residual vector. Bodies land on stone at 3 m/s; all means {MODES} modes, all followed, and near fields are off. The force is \
             integrated each time, so that what the modes leave out changes it too.\n\n{}",
            table(&head, &rows)
        );
    }

    fn chart(&self) -> Chart {
        let series = self.stress.iter().enumerate().map(|(i, row)| Series {
            name: row.name.clone(),
            points: row.points.iter().map(|&(r, s)| (1e3 * r, s)).collect(),
            marker: [
                Marker::Disc,
                Marker::Square,
                Marker::Diamond,
                Marker::Triangle,
            ][i % 4],
            line: true,
        });
        Chart {
            title: "Far face of a plate of 1 mm, pushed by 100 N".into(),
            x: Axis::log("distance from the contact, mm"),
            y: Axis::linear("hoop stress, MPa"),
            series: series.collect(),
        }
    }
}

impl StressRow {
    /// The points next to the table's distances.
    fn at_columns(&self) -> Vec<(f64, f64)> {
        let nearest = |&r: &f64| {
            let off = |p: &(f64, f64)| (p.0 - r).abs();
            self.points
                .iter()
                .copied()
                .min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        COLUMNS.iter().filter_map(nearest).collect()
    }
}

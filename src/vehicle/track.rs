//! Poses over time from a file: a table with a header, or the TUM format.
//!
//! Knows nothing of frames: it is asked for a time or a row.

use std::path::{Path, PathBuf};

use glam::{DMat3, DVec3};
use thiserror::Error;

use crate::math::Pose;
use crate::math::real::{acos, cos, radians, sin};

/// Largest file, bytes.
const MAX_BYTES: u64 = 64 << 20;
/// How far from 1 the length of a quaternion may be: files have few digits.
const LENGTH_OFF: f64 = 1e-2;
/// Cosine of the angle between quaternions above which the chord is as good as the arc.
const NEARLY_ONE: f64 = 0.999_999;

/// Poses at times that grow from row to row.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    times: Vec<f64>,
    positions: Vec<DVec3>,
    turns: Vec<Quaternion>,
}

/// A file of poses that cannot be used.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{path} {problem}", path = path.display())]
pub struct TrackError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it, reading on from its name, with the line, and the remedy.
    pub problem: String,
}

/// x, y, z, w of a turn, of length 1: ROS's order and TUM's.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Quaternion([f64; 4]);

/// A row as it was read: time, position, turn.
type Row = (f64, DVec3, Quaternion);

impl Track {
    /// Reads a file of poses, world_from_vehicle: metres, x east, y north, z up.
    ///
    /// A table of values parted by commas names its columns in its first line: `time_s`, `x`, `y`, `z` (or `x_m` …), and either
    /// `yaw_deg` (counter-clockwise from x), `pitch_deg` (nose up), `roll_deg` (port side up) or a quaternion `qx`, `qy`,
    /// `qz`, `qw`; other columns are passed over. Without commas it is the TUM format: `timestamp tx ty tz qx qy qz qw` parted by
    /// blanks. Lines that begin with `#` are comments. A vehicle's axes are x forward, y port, z up.
    /// Source: TUM RGB-D benchmark, <https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats>; ROS REP 103.
    ///
    /// # Errors
    /// A missing or odd file, with its path, the line and the remedy.
    pub fn load(path: &Path) -> Result<Self, TrackError> {
        let refuse = |problem: String| TrackError { path: path.to_owned(), problem };
        let unreadable = |error: std::io::Error| refuse(format!("cannot be read: {error}"));
        let size = std::fs::metadata(path).map_err(unreadable)?.len();
        if size > MAX_BYTES {
            return Err(refuse(format!("has {} MB; take a file of at most {} MB", size >> 20, MAX_BYTES >> 20)));
        }
        let bytes = std::fs::read(path).map_err(unreadable)?;
        let text =
            String::from_utf8(bytes).map_err(|_| refuse("is no text; take a CSV file or the TUM format".into()))?;
        Self::parse(&text).map_err(refuse)
    }

    /// How many rows it has, at least one.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.times.len() as u64
    }

    /// Time of the first row, seconds.
    #[must_use]
    pub fn begin_s(&self) -> f64 {
        self.times.first().copied().unwrap_or(0.0)
    }

    /// Time of the last row, seconds.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Pose and time of a row; of the last one beyond the end.
    pub(super) fn row(&self, row: usize) -> (Pose, f64) {
        let row = row.min(self.times.len() - 1);
        (Pose { position: self.positions[row], rotation: self.turns[row].rotation() }, self.times[row])
    }

    /// The pose at a time between two rows: on the straight way, on the shortest turn.
    pub(super) fn at(&self, time_s: f64) -> Pose {
        let after = self.times.partition_point(|&time| time <= time_s);
        if after == 0 || after == self.times.len() {
            return self.row(after.saturating_sub(1)).0;
        }
        let (from, to) = (self.times[after - 1], self.times[after]);
        let share = (time_s - from) / (to - from);
        let position = self.positions[after - 1] + (self.positions[after] - self.positions[after - 1]) * share;
        Pose { position, rotation: self.turns[after - 1].towards(self.turns[after], share).rotation() }
    }

    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim_start_matches('\u{feff}');
        let lines = (1..).zip(text.lines());
        let mut lines =
            lines.filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#')).peekable();
        let Some(&(_, first)) = lines.peek() else {
            return Err("has no rows; write one line for each pose".to_owned());
        };
        let mut track = Self { times: Vec::new(), positions: Vec::new(), turns: Vec::new() };
        let columns = if first.contains(',') {
            Some(Columns::of(first, lines.next().map_or(1, |(line, _)| line))?)
        } else {
            None
        };
        for (number, line) in lines {
            let row = match &columns {
                Some(columns) => columns.row(line),
                None => tum(line),
            };
            let (time, position, turn) = row.map_err(|problem| format!("line {number}: {problem}"))?;
            if let Some(before) = track.times.last().filter(|&&before| time <= before) {
                return Err(format!(
                    "line {number}: time {time} does not come after {before}; sort the rows by time, each time once"
                ));
            }
            track.times.push(time);
            track.positions.push(position);
            track.turns.push(turn);
        }
        if track.times.is_empty() {
            return Err("has a header and no rows; write one line for each pose".to_owned());
        }
        Ok(track)
    }
}

/// Where a table has what.
struct Columns {
    count: usize,
    time: usize,
    position: [usize; 3],
    turn: TurnColumns,
}

enum TurnColumns {
    /// Yaw, pitch, roll.
    Angles([usize; 3]),
    /// x, y, z, w.
    Quaternion([usize; 4]),
}

impl Columns {
    fn of(header: &str, line: usize) -> Result<Self, String> {
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let find = |wanted: &[&str]| {
            let found = names.iter().position(|name| wanted.contains(name));
            found.ok_or_else(|| {
                format!(
                    "line {line}: there is no column `{}`; begin with the header \
                     time_s,x,y,z,yaw_deg,pitch_deg,roll_deg or time_s,x,y,z,qx,qy,qz,qw",
                    wanted[0]
                )
            })
        };
        let turn = if names.contains(&"qw") {
            TurnColumns::Quaternion([find(&["qx"])?, find(&["qy"])?, find(&["qz"])?, find(&["qw"])?])
        } else {
            TurnColumns::Angles([find(&["yaw_deg"])?, find(&["pitch_deg"])?, find(&["roll_deg"])?])
        };
        let position = [find(&["x", "x_m"])?, find(&["y", "y_m"])?, find(&["z", "z_m"])?];
        Ok(Self { count: names.len(), time: find(&["time_s"])?, position, turn })
    }

    fn row(&self, line: &str) -> Result<Row, String> {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.len() != self.count {
            return Err(format!(
                "{} values under {} columns; give every row as many as the header",
                cells.len(),
                self.count
            ));
        }
        let at = |column: usize| number(cells[column]);
        let [x, y, z] = self.position;
        let turn = match self.turn {
            TurnColumns::Angles([yaw, pitch, roll]) => Quaternion::from_angles(at(yaw)?, at(pitch)?, at(roll)?),
            TurnColumns::Quaternion([x, y, z, w]) => Quaternion::checked([at(x)?, at(y)?, at(z)?, at(w)?])?,
        };
        Ok((at(self.time)?, DVec3::new(at(x)?, at(y)?, at(z)?), turn))
    }
}

/// A row of the TUM format.
fn tum(line: &str) -> Result<Row, String> {
    let values = line.split_whitespace().map(number).collect::<Result<Vec<f64>, String>>()?;
    let &[time, x, y, z, qx, qy, qz, qw] = values.as_slice() else {
        return Err(format!("{} values; write the 8 of `timestamp tx ty tz qx qy qz qw`", values.len()));
    };
    Ok((time, DVec3::new(x, y, z), Quaternion::checked([qx, qy, qz, qw])?))
}

/// Far enough for everything in metres, degrees and seconds since 1970.
const LARGEST: f64 = 1e12;

fn number(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().map_err(|_| format!("`{text}` is no number; write one such as 1.5"))?;
    if value.abs() <= LARGEST { Ok(value) } else { Err(format!("`{text}` is no finite number; leave the row out")) }
}

impl Quaternion {
    fn checked(parts: [f64; 4]) -> Result<Self, String> {
        let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        if (length - 1.0).abs() > LENGTH_OFF {
            return Err(format!("the quaternion has the length {length:.4}; write x, y, z, w of length 1"));
        }
        Ok(Self(parts).normalised())
    }

    fn normalised(self) -> Self {
        let length = self.0.iter().map(|part| part * part).sum::<f64>().sqrt();
        Self(self.0.map(|part| part / length))
    }

    /// Roll, then pitch, then yaw, as [`Pose::from_angles`] has them, degrees.
    fn from_angles(yaw_deg: f64, pitch_deg: f64, roll_deg: f64) -> Self {
        // Nose up is a negative right-hand turn about y.
        let [yaw, pitch, roll] = [yaw_deg, -pitch_deg, roll_deg].map(|angle| 0.5 * radians(angle));
        let ((sy, cy), (sp, cp), (sr, cr)) = ((sin(yaw), cos(yaw)), (sin(pitch), cos(pitch)), (sin(roll), cos(roll)));
        Self([
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ])
    }

    /// Source: Shoemake (1985), Animating rotation with quaternion curves, SIGGRAPH.
    fn towards(self, other: Self, share: f64) -> Self {
        let dot: f64 = self.0.iter().zip(&other.0).map(|(a, b)| a * b).sum();
        // A quaternion and its negative are the same turn: the nearer of the two is meant.
        let (dot, sign) = if dot < 0.0 { (-dot, -1.0) } else { (dot, 1.0) };
        let (a, b) = if dot > NEARLY_ONE {
            (1.0 - share, share)
        } else {
            let angle = acos(dot);
            (sin((1.0 - share) * angle) / sin(angle), sin(share * angle) / sin(angle))
        };
        Self(std::array::from_fn(|k| a * self.0[k] + sign * b * other.0[k])).normalised()
    }

    fn rotation(self) -> DMat3 {
        let [x, y, z, w] = self.0;
        DMat3::from_cols(
            DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
            DVec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
            DVec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [100.0, -20.0, 5.0], [-170.0, 30.0, -40.0], [175.0, 10.0, 60.0]];

    fn table() -> String {
        let row =
            |(k, [yaw, pitch, roll]): (usize, &[f64; 3])| format!("{}.5, {k}, -1, 2.5, {yaw}, {pitch}, {roll}\n", k);
        let rows: String = ANGLES.iter().enumerate().map(row).collect();
        format!("# a comment\ntime_s, x, y_m, z, yaw_deg, pitch_deg, roll_deg\n{rows}")
    }

    fn same(a: &Pose, b: &Pose, off: f64) {
        assert!((a.position - b.position).length() < off, "{a:?} {b:?}");
        let columns = [0, 1, 2].map(|k| (a.rotation.col(k) - b.rotation.col(k)).length());
        assert!(columns.iter().all(|&column| column < off), "{a:?} {b:?}");
    }

    #[test]
    fn a_table_of_angles_and_tum_give_the_same_poses() {
        let track = Track::parse(&table()).expect("a table");
        let quaternions = |separator: &str| {
            let row = |(k, [yaw, pitch, roll]): (usize, &[f64; 3])| {
                let turn = Quaternion::from_angles(*yaw, *pitch, *roll);
                // The negative is the same turn.
                let [x, y, z, w] = turn.0.map(|part| if k % 2 == 0 { part } else { -part });
                let values = [k as f64 + 0.5, k as f64, -1.0, 2.5, x, y, z, w].map(|value| value.to_string());
                values.join(separator) + "\n"
            };
            ANGLES.iter().enumerate().map(row).collect::<String>()
        };
        let tum = Track::parse(&format!("# timestamp tx ty tz qx qy qz qw\n{}", quaternions("  "))).expect("TUM");
        let csv = Track::parse(&format!("time_s,x,y,z,qx,qy,qz,qw\n{}", quaternions(","))).expect("a table");
        for (k, [yaw, pitch, roll]) in ANGLES.into_iter().enumerate() {
            let expected =
                Pose::from_angles(DVec3::new(k as f64, -1.0, 2.5), radians(yaw), radians(pitch), radians(roll));
            let (pose, time) = track.row(k);
            assert_eq!(time, k as f64 + 0.5);
            same(&pose, &expected, 1e-12);
        }
        for k in 0..=40 {
            let time = 0.5 + f64::from(k) * 0.075;
            same(&track.at(time), &tum.at(time), 1e-12);
            same(&track.at(time), &csv.at(time), 1e-12);
        }
    }

    #[test]
    fn between_rows_it_turns_evenly_and_the_short_way() {
        let track = Track::parse("time_s,x,y,z,yaw_deg,pitch_deg,roll_deg\n0,0,0,0,170,0,0\n2,4,0,0,-150,0,0\n")
            .expect("two rows");
        for k in 0..=8 {
            let time = f64::from(k) * 0.25;
            let expected = Pose::from_angles(DVec3::new(2.0 * time, 0.0, 0.0), radians(170.0 + 20.0 * time), 0.0, 0.0);
            same(&track.at(time), &expected, 1e-12);
        }
        same(&track.at(-5.0), &track.row(0).0, 1e-15);
        same(&track.at(99.0), &track.row(1).0, 1e-15);
    }

    #[test]
    fn odd_files_are_refused_with_line_and_remedy() {
        let told = |text: &str, words: &[&str]| {
            let message = Track::parse(text).expect_err(text);
            words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
        };
        let header = "time_s,x,y,z,yaw_deg,pitch_deg,roll_deg\n";
        told("", &["no rows"]);
        told("# nothing\n\n", &["no rows"]);
        told(header, &["header and no rows"]);
        told("t,x,y,z,yaw_deg,pitch_deg,roll_deg\n", &["line 1", "`time_s`"]);
        told("time_s,x,y,z,yaw_deg,pitch_deg\n", &["`roll_deg`", "qx,qy,qz,qw"]);
        told(&format!("{header}0,1,2,3,4,5\n"), &["line 2", "6 values under 7 columns"]);
        told(&format!("{header}\n0,1,2,3,4,5,up\n"), &["line 3", "`up` is no number"]);
        told(&format!("{header}0,1,nan,3,4,5,6\n"), &["line 2", "`nan`", "finite"]);
        told(&format!("{header}1,0,0,0,0,0,0\n1,0,0,0,0,0,0\n"), &["line 3", "does not come after 1", "sort"]);
        told("0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0\n", &["line 2", "7 values", "qx qy qz qw"]);
        told("0 1 2 3 0 0 0.5 1\n", &["line 1", "length 1.118"]);
        told("0 1 2 3 0 0 0 0\n", &["length 0.0000"]);
        told("0 inf 2 3 0 0 0 1\n", &["`inf`"]);
        let missing = Track::load(Path::new("/no/such.csv")).expect_err("missing").to_string();
        assert!(missing.contains("such.csv") && missing.contains("cannot be read"), "{missing}");
    }
}

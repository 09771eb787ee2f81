//! How many scenes, and how many frames of each, make so many images.

/// Images where nobody says how many: enough to look at, in a minute.
pub const IMAGES: u64 = 100;
/// Fewest scenes that are dealt out to training, validation and test: one of each at least.
pub const LEAST_SCENES_TO_SPLIT: u64 = 10;
/// Shares of training, validation and test.
pub const SHARES: [f64; 3] = [0.8, 0.1, 0.1];

/// What a way of moving wants of its frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// So many in each scene, neither more nor fewer.
    Exactly(u64),
    /// About so many in each scene.
    About(u64),
    /// About so many along a way, which fewer would leave gaps in.
    Along(u64),
    /// All in one scene.
    OneScene,
}

/// Scenes and frames of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Independent draws of the world.
    pub scenes: u64,
    /// Frames of each.
    pub frames: u64,
}

/// Scenes × frames = images, exactly.
///
/// # Errors
/// The nearest numbers of images that could be, where these cannot.
pub fn budget(images: Option<u64>, scenes: Option<u64>, frames: Frames) -> Result<Budget, [u64; 2]> {
    let whole = |images: u64, by: u64| match (images % by, images / by) {
        (0, times) => Ok(times),
        (_, 0) => Err([by; 2]),
        (_, times) => Err([times * by, (times + 1) * by]),
    };
    let made = |scenes: u64, frames: u64| Ok(Budget { scenes, frames });
    match (images, scenes.map(|count| count.max(1)), frames) {
        (Some(images), Some(scenes), Frames::Exactly(each)) => {
            if scenes * each == images {
                made(scenes, each)
            } else {
                Err([scenes * each; 2])
            }
        }
        (Some(images), Some(scenes), _) => made(scenes, whole(images, scenes)?),
        (Some(images), None, Frames::Exactly(each)) => made(whole(images, each)?, each),
        (Some(images), None, Frames::OneScene) => made(1, images),
        (Some(images), None, Frames::About(each)) => {
            let each = near_divisor(images, each.min(root(images)));
            made(images / each, each)
        }
        (Some(images), None, Frames::Along(each)) => {
            let each = near_divisor(images, each.min(images));
            made(images / each, each)
        }
        (None, Some(scenes), Frames::Exactly(each) | Frames::About(each) | Frames::Along(each)) => made(scenes, each),
        (None, Some(scenes), Frames::OneScene) => made(scenes, 10),
        (None, None, Frames::Exactly(each)) => made((IMAGES / each).clamp(1, 10), each),
        (None, None, Frames::OneScene) => made(1, 20),
        (None, None, Frames::About(each) | Frames::Along(each)) => {
            made((IMAGES / each).max(1), IMAGES / (IMAGES / each).max(1))
        }
    }
}

/// The whole part of the root: of few images several scenes are made, five of two rather than one of ten.
fn root(images: u64) -> u64 {
    let near = (images as f64).sqrt() as u64;
    (near.saturating_sub(1)..=near + 1).rev().find(|root| root * root <= images).unwrap_or(1)
}

/// The divisor that is nearest in ratio to so many.
fn near_divisor(images: u64, wanted: u64) -> u64 {
    let root = root(images);
    let wanted = wanted.max(1) as f64;
    let apart = |divisor: &u64| {
        let ratio = *divisor as f64 / wanted;
        ratio.max(1.0 / ratio)
    };
    let divisors = (1..=root).filter(|low| images.is_multiple_of(*low)).flat_map(|low| [low, images / low]);
    divisors.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_product_is_what_was_asked_for() {
        for images in (1..400).chain([997, 1000, 2048, 9973, 100_000, 1_000_003]) {
            for frames in [Frames::About(10), Frames::About(1), Frames::Along(30), Frames::OneScene] {
                let Budget { scenes, frames } = budget(Some(images), None, frames).expect("one scene always does");
                assert_eq!(scenes * frames, images);
            }
        }
        assert_eq!(budget(Some(300), None, Frames::About(10)), Ok(Budget { scenes: 30, frames: 10 }));
        assert_eq!(budget(Some(997), None, Frames::About(10)), Ok(Budget { scenes: 997, frames: 1 }));
        assert_eq!(budget(Some(300), None, Frames::Exactly(3)), Ok(Budget { scenes: 100, frames: 3 }));
        assert_eq!(budget(Some(20), None, Frames::Along(30)), Ok(Budget { scenes: 1, frames: 20 }));
        assert_eq!(budget(Some(100), Some(20), Frames::About(10)), Ok(Budget { scenes: 20, frames: 5 }));
    }

    #[test]
    fn what_does_not_divide_is_refused_with_what_does() {
        assert_eq!(budget(Some(100), None, Frames::Exactly(3)), Err([99, 102]));
        assert_eq!(budget(Some(7), Some(10), Frames::About(10)), Err([10, 10]));
        assert_eq!(budget(Some(7), Some(2), Frames::Exactly(3)), Err([6, 6]));
    }
}

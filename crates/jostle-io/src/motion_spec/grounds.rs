//! Ground that differs under the buildings of a model file: arrivals, own records, loss of coherency, and vertical shaking.

use jostle::{Bearing, GroundMotion, Grounds, OwnGround, Wave};
use jostle_motion::{Accelerogram, Coherency, coherent_with};

use super::{MotionError, MotionSource, MotionSpec, Scaling};
use crate::baseline::Baseline;

/// What `[motion]`, `[building.motion]` and positions say of grounds that differ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundsSpec {
    /// Speed at which waves pass along the row, > 0; arrivals are positions over it \[m/s\].
    pub apparent_velocity: Option<f64>,
    /// Angle from x to the direction in which waves travel among buildings with a plan \[rad\].
    pub wave_angle: Option<f64>,
    /// What becomes of velocities that drift; `None` refuses records that differ and drift apart.
    pub baseline: Option<Baseline>,
    /// Loss of coherency with distance.
    pub coherency: Option<Coherency>,
    /// Vertical shaking.
    pub vertical: Option<Box<OwnMotionSpec>>,
    /// The ground under every building, then under every wall.
    pub own: Vec<OwnGroundSpec>,
}

/// The ground under one building or wall.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnGroundSpec {
    /// Name of the building or wall.
    pub name: String,
    /// Place along the row \[m\].
    pub position: Option<f64>,
    /// When the motion arrives, ≥ 0 \[s\].
    pub arrival: Option<f64>,
    /// Its own motion.
    pub motion: Option<Box<OwnMotionSpec>>,
    /// Its own vertical motion.
    pub vertical: Option<Box<OwnMotionSpec>>,
    /// A wall without a position moves with the building of this index, which it faces.
    pub like: Option<usize>,
}

/// A motion beside the common one.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnMotionSpec {
    /// Its source; `None` is that of the common motion.
    pub source: Option<MotionSource>,
    /// Its scaling; without one it has the factor of the common motion.
    pub scaling: Scaling,
    /// Whether its sign is changed.
    pub reverse: bool,
}

/// Changes the seed of the random part of the component across.
const ACROSS: u64 = 1 << 54;

/// End velocities may differ by this share of the greatest ground velocity (theory, Eq. B16).
const MOST_DRIFT: f64 = 0.01;

impl GroundsSpec {
    /// Whether every building stands on the common ground and nothing shakes vertically.
    #[must_use]
    pub fn is_common(&self) -> bool {
        let is_plain = |spec: &OwnGroundSpec| {
            spec.motion.is_none()
                && spec.vertical.is_none()
                && spec.arrival.is_none_or(|at| at == 0.0)
        };
        let waves = self.apparent_velocity.is_some() || self.coherency.is_some();
        self.vertical.is_none() && !waves && self.own.iter().all(is_plain)
    }

    /// The ground that a building or wall stands on.
    fn under(&self, index: usize) -> &OwnGroundSpec {
        let spec_own = &self.own[index];
        spec_own
            .like
            .and_then(|like| self.own.get(like))
            .unwrap_or(spec_own)
    }

    /// When the motion arrives at a building or wall, numbered from the first building \[s\].
    #[must_use]
    pub fn arrival(&self, index: usize) -> f64 {
        let ground = self.under(index);
        match (ground.arrival, ground.position, self.apparent_velocity) {
            (Some(arrival), _, _) => arrival,
            (None, Some(position), Some(velocity)) => position / velocity,
            (None, _, _) => 0.0,
        }
    }

    /// The grounds in numbers, `spec` being resolved already as `common`.
    ///
    /// # Errors
    /// [`MotionError`] with the building where it is to be found.
    pub(crate) fn resolve(
        &self,
        spec: &MotionSpec,
        common: &GroundMotion,
    ) -> Result<Option<Box<Grounds>>, MotionError> {
        if self.is_common() {
            return Ok(None);
        }
        let made = self.coherent(common)?;
        let common_vertical = self.vertical.as_deref();
        let common_vertical = common_vertical
            .map(|vertical| {
                let found = self.motion(vertical, spec, common);
                found.map_err(|error| within("motion.vertical", error))
            })
            .transpose()?;
        let mut grounds = Vec::with_capacity(self.own.len());
        for index in 0..self.own.len() {
            let ground = self.under(index);
            let building = ground.like.unwrap_or(index);
            let path = |key: &str| format!("building[{building}].motion{key}");
            let motion = ground.motion.as_deref();
            let motion = motion.map(|motion| {
                let found = self.motion(motion, spec, common);
                found.map_err(|error| within(&path(""), error))
            });
            let vertical = ground.vertical.as_deref();
            let vertical = vertical.map(|motion| {
                let found = self.motion(motion, spec, common);
                found.map_err(|error| within(&path(".vertical"), error))
            });
            grounds.push(OwnGround {
                arrival: self.arrival(index),
                motion: motion.transpose()?.or_else(|| made[index].clone()),
                vertical: vertical.transpose()?.or_else(|| common_vertical.clone()),
            });
        }
        self.check_drift(common, &grounds)?;
        let differs = |ground: &OwnGround| *ground != OwnGround::default();
        let differ = grounds.iter().any(differs);
        Ok(differ.then(|| Box::new(Grounds { own: grounds })))
    }

    /// A motion beside the common one.
    fn motion(
        &self,
        local_spec: &OwnMotionSpec,
        spec: &MotionSpec,
        common: &GroundMotion,
    ) -> Result<GroundMotion, MotionError> {
        let source = local_spec.source.as_ref().unwrap_or(&spec.source);
        let mut motion = MotionSpec {
            source: source.clone(),
            scaling: local_spec.scaling.clone(),
            reverse: local_spec.reverse,
            // A sine lasts as long as the common motion, a record as long as it is.
            duration: matches!(source, MotionSource::Sine { .. }).then_some(common.duration),
            bearing: None,
            grounds: Some(Box::new(Self {
                baseline: self.baseline,
                ..Self::default()
            })),
        }
        .resolve()?;
        // Records of one event keep their ratio, and a share of the common motion is a share; what states an amplitude or a
        // scaling of its own keeps it.
        let follows = match (&local_spec.scaling, &local_spec.source) {
            (Scaling::AsRecorded | Scaling::Factor(_), None) => true,
            (Scaling::AsRecorded, Some(source)) => !source.states_its_size(),
            (
                Scaling::Factor(_) | Scaling::FactorOfEach(_) | Scaling::Pga(_) | Scaling::Match(_),
                _,
            ) => false,
        };
        if follows {
            motion.scale *= common.scale;
        }
        Ok(motion)
    }

    /// Motions that have lost coherency with the record, which is that of position 0.
    fn coherent(&self, common: &GroundMotion) -> Result<Vec<Option<GroundMotion>>, MotionError> {
        let Some(coherency) = &self.coherency else {
            return Ok(vec![None; self.own.len()]);
        };
        let place = |index: usize| self.under(index).position.unwrap_or(0.0);
        let places: Vec<f64> = (0..self.own.len()).map(place).collect();
        let mut made = less_coherent(common, &places, coherency)?;
        if let (Some(bearing), Some(across)) = (&common.bearing, common.across()) {
            // Its random part is another one.
            let coherency = Coherency {
                seed: coherency.seed ^ ACROSS,
                ..*coherency
            };
            let across = less_coherent(across, &places, &coherency)?;
            for (made, across) in made.iter_mut().zip(across) {
                if let Some(motion) = made {
                    motion.bearing = Some(Box::new(Bearing {
                        angle: bearing.angle,
                        across,
                    }));
                }
            }
        }
        Ok(made)
    }

    /// Refuses different records whose end velocities differ (theory, Eq. B16).
    fn check_drift(&self, common: &GroundMotion, grounds: &[OwnGround]) -> Result<(), MotionError> {
        if self.baseline.is_some() || self.coherency.is_some() {
            return Ok(());
        }
        let mut known: Vec<(&GroundMotion, [f64; 2])> = Vec::new();
        for ground in grounds {
            let motion = ground.motion.as_ref().unwrap_or(common);
            if !known.iter().any(|(other, _)| *other == motion) {
                known.push((motion, end_and_peak(motion)));
            }
        }
        let peak = known.iter().map(|(_, [_, peak])| *peak);
        let peak = peak.fold(0.0_f64, f64::max);
        let ends = || known.iter().map(|(motion, [end, _])| (motion, *end));
        let least = ends().min_by(|a, b| a.1.total_cmp(&b.1));
        let most = ends().max_by(|a, b| a.1.total_cmp(&b.1));
        match (least, most) {
            (Some((first, least)), Some((second, most))) if most - least > MOST_DRIFT * peak => {
                Err(MotionError::Drift {
                    names: [first.name.clone(), second.name.clone()],
                    ends: [least, most],
                    peak,
                })
            }
            _ => Ok(()),
        }
    }
}

/// A record as it is at some places; `None` where it was taken.
fn less_coherent(
    motion: &GroundMotion,
    places: &[f64],
    coherency: &Coherency,
) -> Result<Vec<Option<GroundMotion>>, MotionError> {
    let error = |error| MotionError::Coherency { error };
    let Wave::Sampled { step, acceleration } = &motion.wave else {
        return Err(MotionError::NoRecord);
    };
    let record = Accelerogram::new(*step, acceleration.clone()).map_err(error)?;
    let made = coherent_with(&record, places, coherency).map_err(error)?;
    let made = made.into_iter().zip(places).map(|(made, place)| {
        (*place != 0.0).then(|| GroundMotion {
            name: format!("{} at {place} m", motion.name),
            scale: motion.scale,
            ..GroundMotion::sampled("", *step, made.acceleration().to_vec())
        })
    });
    Ok(made.collect())
}

/// Velocity at the end of a motion, and the greatest of all \[m/s\].
fn end_and_peak(motion: &GroundMotion) -> [f64; 2] {
    // Along itself, not in its direction in plan.
    let alone = GroundMotion {
        bearing: None,
        grounds: None,
        ..motion.clone()
    };
    let path = alone.under(0);
    let steps = match &alone.wave {
        Wave::Sampled { step, .. } => (alone.duration / step).round(),
        Wave::Sine { .. } | Wave::Ricker { .. } => 2000.0,
    };
    let at = |i: u32| path.at(alone.duration * f64::from(i) / steps).velocity[0];
    let all = (0..=steps as u32).map(at);
    [at(steps as u32), all.fold(0.0, |most, v| most.max(v.abs()))]
}

/// Puts an error at the place of a motion beside the common one.
fn within(path: &str, error: MotionError) -> MotionError {
    MotionError::Own {
        path: path.to_owned(),
        error: Box::new(error),
    }
}

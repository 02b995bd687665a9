//! Rows of one shape, a row per lane, stepped together.
//!
//! Leapfrog: a_n from springs, damping and contacts with the velocity v_n = v_{n−½} + ½ h a_{n−1}; then v_{n+½} and
//! u_{n+1}.

use crate::lanes::{Real, each};
use crate::peaks::{BuildingPeaks, ContactPeaks, Peaks};
use crate::row::{Building, Face, Motion, Row, Rule};

/// Contacts that start more slowly keep the greatest closing speed since then \[m/s\].
const SLOW: f64 = 1e-3;

/// What rows have in common that share lanes: all but the number of storeys, which comes last so that like sizes
/// stand side by side.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Shape {
    motion: usize,
    /// Sub-steps of a step of the motion.
    sub: usize,
    rules: Vec<u8>,
    /// Per gap: floors of its contacts, and whether a share goes to the floors below.
    contacts: Vec<Vec<[(usize, bool); 2]>>,
    storeys: Vec<usize>,
}

impl Shape {
    pub(crate) fn of(row: &Row, motions: &[Motion], phase: f64) -> Self {
        let highest = row.buildings.iter().map(Building::highest_squared);
        let highest = highest.fold(0.0, f64::max).sqrt();
        // Four significant steps per doubling, so that more rows share lanes.
        let needed = (motions[row.motion].step * highest / phase)
            .ceil()
            .clamp(4.0, 1e6) as usize;
        let grain = (needed.next_power_of_two() / 8).max(1);
        let rule = |building: &Building| match building.rule {
            Rule::Elastic => 0,
            Rule::Bilinear => 1,
            Rule::PeakOriented | Rule::Pinched { .. } => 2,
        };
        let face = |face: Face| (face.floor, face.share < 1.0);
        let contacts = |gap: &crate::row::Gap| {
            let contacts = gap.contacts.iter();
            contacts
                .map(|contact| [face(contact.left), face(contact.right)])
                .collect()
        };
        Self {
            motion: row.motion,
            sub: needed.div_ceil(grain) * grain,
            rules: row.buildings.iter().map(rule).collect(),
            contacts: row.gaps.iter().map(contacts).collect(),
            storeys: row
                .buildings
                .iter()
                .map(|building| building.storeys.len())
                .collect(),
        }
    }

    pub(crate) fn shares_lanes_with(&self, other: &Self) -> bool {
        let key = |shape: &Self| (shape.motion, shape.sub);
        key(self) == key(other) && self.rules == other.rules && self.contacts == other.contacts
    }
}

/// A storey with the floor above: constants, state and peaks of all lanes. Springs are kept in the frame of the
/// side on which they are, where force and deformation are positive.
struct Floor<T, const W: usize> {
    inverse_mass: [T; W],
    mass_damping: [T; W],
    stiffness_damping: [T; W],
    k1: [T; W],
    k2: [T; W],
    k3: [T; W],
    q1: [T; W],
    q2: [T; W],
    corner: [T; W],
    pinch: [[T; W]; 2],
    exponent: [T; W],
    /// +1 or −1: the side.
    side: [T; W],
    /// Peak of this side and of the other.
    peak: [T; W],
    other_peak: [T; W],
    /// Where force vanished.
    zero: [T; W],
    force: [T; W],
    at: [T; W],
    unloading: [T; W],
    /// The peak for which the lines were drawn.
    aim: [T; W],
    pinch_at: [T; W],
    pinch_force: [T; W],
    slope1: [T; W],
    slope2: [T; W],
    /// 1 once the peak has moved and unloading is not yet drawn anew.
    moved: [T; W],
    u: [T; W],
    v: [T; W],
    a: [T; W],
    /// Forces on the floor.
    sum: [T; W],
    drift: [T; W],
    acceleration: [T; W],
}

/// A contact of all lanes.
struct Touch<T, const W: usize> {
    /// Floor with its share, and the floor below, left and right.
    faces: [(usize, Option<usize>); 2],
    shares: [[T; W]; 2],
    gap: [T; W],
    stiffness: [T; W],
    hertz: [T; W],
    by_ratio: [T; W],
    by_rate: [T; W],
    tension: [T; W],
    /// Closing speed at the touch; 0 apart.
    v0: [T; W],
    slow: [T; W],
    before: [T; W],
    closing: [T; W],
    peak: [T; W],
    impulse: [T; W],
    impacts: [u32; W],
}

impl<T: Real, const W: usize> Floor<T, W> {
    #[inline(always)]
    fn backbone(&self, l: usize, u: T) -> T {
        let first = (self.k1[l] * u).least(self.q1[l] + self.k2[l] * u);
        first.least(self.q2[l] + self.k3[l] * u)
    }

    fn unload(&self, l: usize, peak: T) -> T {
        let softer = (self.corner[l] / peak).least(T::ONE);
        let softer = if self.exponent[l] > T::ZERO && softer < T::ONE {
            softer.power(self.exponent[l])
        } else {
            T::ONE
        };
        (self.k1[l] * softer).most(self.backbone(l, peak) / peak)
    }

    /// Draws the two lines from zero force to the peak.
    fn draw(&mut self, l: usize) {
        let (peak, k, zero) = (self.peak[l], self.unloading[l], self.zero[l]);
        let force = self.backbone(l, peak);
        let [px, py] = [self.pinch[0][l], self.pinch[1][l]];
        let way = (px * (peak - (T::ONE - py) * force / k - zero)).most(T::SHORT);
        self.pinch_at[l] = zero + way;
        self.pinch_force[l] = py * force;
        self.slope1[l] = py * force / way;
        self.slope2[l] = (force - py * force) / (peak - self.pinch_at[l]).most(T::SHORT);
        self.aim[l] = peak;
    }

    /// Force passes through zero in a lane: the other side.
    fn cross(&mut self, l: usize) {
        self.zero[l] = self.force[l] / self.unloading[l] - self.at[l];
        (self.peak[l], self.other_peak[l]) = (self.other_peak[l], self.peak[l]);
        self.unloading[l] = self.unload(l, self.peak[l]);
        self.moved[l] = T::ZERO;
        self.side[l] = -self.side[l];
        self.draw(l);
    }

    #[inline(always)]
    fn spring(&mut self, rule: u8, d: &[T; W]) -> [T; W] {
        match rule {
            0 => each(|l| self.k1[l] * d[l]),
            1 => {
                let force = each(|l| {
                    let trial = self.force[l] + self.k1[l] * (d[l] - self.at[l]);
                    let line = self.k2[l] * d[l];
                    trial.least(self.q1[l] + line).most(line - self.q1[l])
                });
                self.force = force;
                self.at = *d;
                force
            }
            _ => self.reload(d),
        }
    }

    #[inline(always)]
    fn reload(&mut self, d: &[T; W]) -> [T; W] {
        let mut u: [T; W] = each(|l| self.side[l] * d[l]);
        let mut turned = false;
        for l in 0..W {
            turned |= (self.moved[l] > T::ZERO) & (u[l] < self.at[l]);
        }
        if turned {
            for l in 0..W {
                if self.moved[l] > T::ZERO && u[l] < self.at[l] {
                    self.unloading[l] = self.unload(l, self.peak[l]);
                    self.moved[l] = T::ZERO;
                }
            }
        }
        let mut trial: [T; W] = each(|l| self.force[l] + self.unloading[l] * (u[l] - self.at[l]));
        let mut crossed = false;
        for l in 0..W {
            crossed |= trial[l] < T::ZERO;
        }
        if crossed {
            for l in 0..W {
                if trial[l] < T::ZERO {
                    self.cross(l);
                    u[l] = -u[l];
                    trial[l] = self.unloading[l] * (u[l] - self.zero[l]);
                }
            }
        }
        for l in 0..W {
            let first = self.slope1[l] * (u[l] - self.zero[l]);
            let second = self.pinch_force[l] + self.slope2[l] * (u[l] - self.pinch_at[l]);
            let lines = if u[l] < self.pinch_at[l] {
                first
            } else {
                second
            };
            let bound = if u[l] < self.aim[l] {
                lines
            } else {
                self.backbone(l, u[l])
            };
            let beyond = u[l] > self.peak[l];
            self.peak[l] = if beyond { u[l] } else { self.peak[l] };
            self.moved[l] = if beyond { T::ONE } else { self.moved[l] };
            self.force[l] = trial[l].least(bound).most(T::ZERO);
            self.at[l] = u[l];
        }
        each(|l| self.side[l] * self.force[l])
    }

    /// A floor without any building, for lanes of fewer storeys: nothing holds it and nothing acts on it but the
    /// ground.
    fn empty() -> Self {
        let (zero, one) = ([T::ZERO; W], [T::ONE; W]);
        Self {
            inverse_mass: one,
            mass_damping: zero,
            stiffness_damping: zero,
            k1: zero,
            k2: zero,
            k3: zero,
            q1: zero,
            q2: zero,
            corner: one,
            pinch: [one; 2],
            exponent: zero,
            side: one,
            peak: one,
            other_peak: one,
            zero,
            force: zero,
            at: zero,
            unloading: one,
            aim: one,
            pinch_at: one,
            pinch_force: zero,
            slope1: zero,
            slope2: zero,
            moved: zero,
            u: zero,
            v: zero,
            a: zero,
            sum: zero,
            drift: zero,
            acceleration: zero,
        }
    }

    fn put(&mut self, l: usize, building: &Building, storey: usize) {
        let storey = &building.storeys[storey];
        let k = storey.stiffness;
        let [c, y] = [storey.first_corner, storey.second_corner];
        let [k2, k3] = [storey.second_ratio * k, storey.third_ratio * k];
        let q1 = (k - k2) * c;
        self.inverse_mass[l] = T::of(1.0 / storey.mass);
        self.mass_damping[l] = T::of(building.alpha * storey.mass);
        self.stiffness_damping[l] = T::of(building.beta * k);
        self.k1[l] = T::of(k);
        if building.rule == Rule::Elastic {
            return;
        }
        self.k2[l] = T::of(k2);
        self.q1[l] = T::of(q1);
        if building.rule == Rule::Bilinear {
            return;
        }
        self.k3[l] = T::of(k3);
        self.q2[l] = T::of(q1 + (k2 - k3) * y);
        let (px, py, exponent) = match building.rule {
            Rule::Pinched {
                deformation,
                force,
                unloading_exponent,
            } => (deformation, force, unloading_exponent),
            _ => (1.0, 1.0, 0.0),
        };
        self.pinch[0][l] = T::of(px);
        self.pinch[1][l] = T::of(py);
        self.exponent[l] = T::of(exponent);
        self.corner[l] = T::of(c);
        self.peak[l] = T::of(c);
        self.other_peak[l] = T::of(c);
        self.unloading[l] = T::of(k);
        self.draw(l);
    }
}

/// All rows of a pack.
struct Pack<T, const W: usize> {
    /// Rule, and its floors.
    buildings: Vec<(u8, Vec<Floor<T, W>>)>,
    touches: Vec<Vec<Touch<T, W>>>,
}

impl<T: Real, const W: usize> Pack<T, W> {
    fn of(shape: &Shape, rows: &[&Row]) -> Self {
        let mut buildings = Vec::new();
        for (at, rule) in shape.rules.iter().enumerate() {
            let most = rows.iter().map(|row| row.buildings[at].storeys.len()).max();
            let mut floors: Vec<_> = (0..most.unwrap_or(0)).map(|_| Floor::empty()).collect();
            for (l, row) in rows.iter().enumerate() {
                for storey in 0..row.buildings[at].storeys.len() {
                    floors[storey].put(l, &row.buildings[at], storey);
                }
            }
            buildings.push((*rule, floors));
        }
        let of_gap = |gap: usize| {
            let count = shape.contacts[gap].len();
            (0..count)
                .map(|contact| Touch::of(rows, gap, contact))
                .collect()
        };
        let touches = (0..shape.contacts.len()).map(of_gap).collect();
        Self { buildings, touches }
    }

    /// At rest under the first ground acceleration: rates are those of half a step before, so that a sudden push acts at once.
    fn rest(&mut self, h: T, ground: &[T; W]) {
        let half = T::of(0.5) * h;
        for floor in self
            .buildings
            .iter_mut()
            .flat_map(|building| &mut building.1)
        {
            floor.a = each(|l| -ground[l]);
            floor.v = each(|l| half * ground[l]);
        }
    }

    /// Everything up to the next accelerations and displacements.
    #[inline(always)]
    fn step(&mut self, h: T, ground: &[T; W]) {
        let half = T::of(0.5) * h;
        for (rule, floors) in &mut self.buildings {
            let (mut below, mut below_rate) = ([T::ZERO; W], [T::ZERO; W]);
            for i in 0..floors.len() {
                let floor = &mut floors[i];
                let d: [T; W] = each(|l| floor.u[l] - below[l]);
                let rate: [T; W] = each(|l| floor.v[l] + half * floor.a[l]);
                let spring = floor.spring(*rule, &d);
                let shear: [T; W] =
                    each(|l| spring[l] + floor.stiffness_damping[l] * (rate[l] - below_rate[l]));
                floor.drift = each(|l| floor.drift[l].most(d[l].size()));
                floor.sum = each(|l| -shear[l] - floor.mass_damping[l] * rate[l]);
                (below, below_rate) = (floor.u, rate);
                if i > 0 {
                    let under = &mut floors[i - 1];
                    under.sum = each(|l| under.sum[l] + shear[l]);
                }
            }
        }
        for (gap, touches) in self.touches.iter_mut().enumerate() {
            let (lefts, rights) = self.buildings.split_at_mut(gap + 1);
            let (left, right) = (&mut lefts[gap].1, &mut rights[0].1);
            for touch in touches {
                touch.step(left, right, h);
            }
        }
        for (_, floors) in &mut self.buildings {
            for floor in floors {
                let total: [T; W] = each(|l| floor.sum[l] * floor.inverse_mass[l]);
                floor.acceleration = each(|l| floor.acceleration[l].most(total[l].size()));
                floor.a = each(|l| total[l] - ground[l]);
                floor.v = each(|l| floor.v[l] + h * floor.a[l]);
                floor.u = each(|l| floor.u[l] + h * floor.v[l]);
            }
        }
    }
}

/// A motion of the face, weighted by shares.
#[inline(always)]
fn of_face<T: Real, const W: usize>(
    floors: &[Floor<T, W>],
    (floor, below): (usize, Option<usize>),
    share: &[T; W],
    read: impl Fn(&Floor<T, W>, usize) -> T,
) -> [T; W] {
    let floor = &floors[floor];
    match below {
        None => each(|l| share[l] * read(floor, l)),
        Some(below) => {
            let below = &floors[below];
            each(|l| share[l] * read(floor, l) + (T::ONE - share[l]) * read(below, l))
        }
    }
}

impl<T: Real, const W: usize> Touch<T, W> {
    fn of(rows: &[&Row], gap: usize, contact: usize) -> Self {
        let first = rows[0].gaps[gap].contacts[contact];
        let face = |face: Face| {
            let below = face.floor.checked_sub(1).filter(|_| face.share < 1.0);
            (face.floor, below)
        };
        let zero = [T::ZERO; W];
        let mut touch = Self {
            faces: [face(first.left), face(first.right)],
            shares: [[T::ONE; W]; 2],
            gap: [T::of(f64::INFINITY); W],
            stiffness: zero,
            hertz: zero,
            by_ratio: zero,
            by_rate: zero,
            tension: zero,
            v0: zero,
            slow: zero,
            before: [-T::ONE; W],
            closing: [T::of(-1e30); W],
            peak: zero,
            impulse: zero,
            impacts: [0; W],
        };
        for (l, row) in rows.iter().enumerate() {
            let contact = row.gaps[gap].contacts[contact];
            let mut inverse = 0.0;
            for (at, (face, building)) in [(contact.left, gap), (contact.right, gap + 1)]
                .into_iter()
                .enumerate()
            {
                touch.shares[at][l] = T::of(face.share);
                let storeys = &row.buildings[building].storeys;
                inverse += face.share * face.share / storeys[face.floor].mass;
                if face.floor > 0 {
                    inverse += (1.0 - face.share).powi(2) / storeys[face.floor - 1].mass;
                }
            }
            if let Some(law) = row.gaps[gap].law {
                let constants = law.constants(1.0 / inverse);
                touch.gap[l] = T::of(row.gaps[gap].width);
                touch.stiffness[l] = T::of(constants.stiffness);
                touch.hertz[l] = if constants.hertz { T::ONE } else { T::ZERO };
                touch.by_ratio[l] = T::of(constants.by_ratio);
                touch.by_rate[l] = T::of(constants.by_rate);
                touch.tension[l] = if constants.hertz { T::ZERO } else { T::ONE };
            }
        }
        touch
    }

    #[inline(always)]
    fn step(&mut self, left: &mut [Floor<T, W>], right: &mut [Floor<T, W>], h: T) {
        let [a, b] = self.faces;
        let read = |floor: &Floor<T, W>, l: usize| floor.u[l];
        let ua = of_face(left, a, &self.shares[0], read);
        let ub = of_face(right, b, &self.shares[1], read);
        let near: [T; W] = each(|l| ua[l] - ub[l]);
        self.closing = each(|l| self.closing[l].most(near[l]));
        let depth: [T; W] = each(|l| near[l] - self.gap[l]);
        let mut any = false;
        for l in 0..W {
            any |= depth[l] > T::ZERO;
        }
        if any {
            self.press(left, right, h, &depth);
        } else {
            self.v0 = [T::ZERO; W];
        }
        self.before = depth;
    }

    /// Forces of the lanes that touch.
    fn press(&mut self, left: &mut [Floor<T, W>], right: &mut [Floor<T, W>], h: T, depth: &[T; W]) {
        let [a, b] = self.faces;
        let of = |read: fn(&Floor<T, W>, usize) -> T| -> [T; W] {
            let one = of_face(left, a, &self.shares[0], read);
            let two = of_face(right, b, &self.shares[1], read);
            each(|l| one[l] - two[l])
        };
        let (v, acceleration) = (of(|floor, l| floor.v[l]), of(|floor, l| floor.a[l]));
        let (half, least) = (T::of(0.5), T::of(1e-6));
        for l in 0..W {
            if depth[l] > T::ZERO {
                let rate = v[l] + half * h * acceleration[l];
                if self.v0[l] == T::ZERO {
                    // The speed where the faces met, between the last step and this one.
                    let part = -self.before[l] / (depth[l] - self.before[l]);
                    let part = part.most(T::ZERO).least(T::ONE);
                    let met = v[l] + (part - half) * h * acceleration[l];
                    self.v0[l] = met.most(least);
                    self.slow[l] = if met < T::of(SLOW) { T::ONE } else { T::ZERO };
                    self.impacts[l] += 1;
                }
                if self.slow[l] > T::ZERO {
                    self.v0[l] = self.v0[l].most(rate);
                }
                let power = if self.hertz[l] > T::ZERO {
                    depth[l].root()
                } else {
                    T::ONE
                };
                let force = self.stiffness[l]
                    * depth[l]
                    * power
                    * (T::ONE + self.by_ratio[l] * rate / self.v0[l])
                    + self.by_rate[l] * rate;
                let force = if self.tension[l] > T::ZERO {
                    force
                } else {
                    force.most(T::ZERO)
                };
                self.peak[l] = self.peak[l].most(force);
                self.impulse[l] += force * h;
                for (floors, (floor, below), share, sign) in [
                    (&mut *left, a, self.shares[0][l], -T::ONE),
                    (&mut *right, b, self.shares[1][l], T::ONE),
                ] {
                    floors[floor].sum[l] += sign * share * force;
                    if let Some(below) = below {
                        floors[below].sum[l] += sign * (T::ONE - share) * force;
                    }
                }
            } else {
                self.v0[l] = T::ZERO;
            }
        }
    }
}

/// The whole motion, with the widest registers at hand.
struct Through<'a, T, const W: usize> {
    pack: &'a mut Pack<T, W>,
    motion: &'a Motion,
    scale: [T; W],
    sub: usize,
}

impl<T: Real, const W: usize> pulp::NullaryFnOnce for Through<'_, T, W> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let h = T::of(self.motion.step / self.sub as f64);
        let first = T::of(self.motion.acceleration.first().copied().unwrap_or(0.0));
        self.pack.rest(h, &each(|l| first * self.scale[l]));
        for points in self.motion.acceleration.windows(2) {
            let slope = (points[1] - points[0]) / self.sub as f64;
            for part in 0..self.sub {
                let ground = T::of(points[0] + slope * part as f64);
                let ground = each(|l| ground * self.scale[l]);
                self.pack.step(h, &ground);
            }
        }
    }
}

/// Steps a pack of at most `W` rows of one shape.
pub(crate) fn simulate<T: Real, const W: usize>(
    shape: &Shape,
    rows: &[&Row],
    motions: &[Motion],
) -> Vec<Peaks> {
    let mut pack = Pack::<T, W>::of(shape, rows);
    let through = Through {
        pack: &mut pack,
        motion: &motions[shape.motion],
        scale: each(|l| T::of(rows.get(l).map_or(0.0, |row| row.scale))),
        sub: shape.sub,
    };
    pulp::Arch::new().dispatch(through);
    rows.iter()
        .enumerate()
        .map(|(l, row)| pack.peaks(l, row))
        .collect()
}

impl<T: Real, const W: usize> Pack<T, W> {
    fn peaks(&self, l: usize, row: &Row) -> Peaks {
        let building = |(at, given): (usize, &Building)| {
            let floors = &self.buildings[at].1[..given.storeys.len()];
            let read = |value: fn(&Floor<T, W>, usize) -> T| -> Vec<f64> {
                floors.iter().map(|floor| value(floor, l).wide()).collect()
            };
            let ends = read(|floor, l| floor.u[l]);
            let below = [0.0].into_iter().chain(ends.iter().copied());
            BuildingPeaks {
                drift: read(|floor, l| floor.drift[l]),
                acceleration: read(|floor, l| floor.acceleration[l]),
                residual: ends.iter().zip(below).map(|(u, below)| u - below).collect(),
            }
        };
        let contact = |(touch, given): (&Touch<T, W>, &crate::row::Contact)| ContactPeaks {
            closing: touch.closing[l].wide(),
            force: touch.peak[l].wide(),
            impulse: touch.impulse[l].wide(),
            impacts: touch.impacts[l],
            column: given.strikes_column(),
        };
        let gap = |(touches, given): (&Vec<Touch<T, W>>, &crate::row::Gap)| {
            touches.iter().zip(&given.contacts).map(contact).collect()
        };
        Peaks {
            buildings: row.buildings.iter().enumerate().map(building).collect(),
            gaps: self.touches.iter().zip(&row.gaps).map(gap).collect(),
        }
    }
}

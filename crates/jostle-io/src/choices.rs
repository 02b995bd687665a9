//! Words of model and study files that choose one of several: each with the list of its members and their names.

/// Names of all members of an enumeration with `ALL` and `name`, or another function, as a constant list.
macro_rules! names {
    ($choice:ty) => {
        names!($choice, name)
    };
    ($choice:ty, $name:ident) => {
        &{
            let mut names = [""; <$choice>::ALL.len()];
            let mut at = 0;
            while at < names.len() {
                names[at] = <$choice>::ALL[at].$name();
                at += 1;
            }
            names
        }
    };
}
pub(crate) use names;

/// Rules that make the cases of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DesignKind {
    /// Every combination of the lists; distributions are drawn `samples` times for each.
    Factorial,
    /// The lists side by side, entry by entry; distributions are drawn `samples` times for each.
    Zipped,
    /// Latin hypercube.
    LatinHypercube,
    /// Sobol sequence.
    Sobol,
    /// Independent draws.
    Random,
    /// Two samples and their mixtures, for Sobol indices.
    Saltelli,
    /// Trajectories of elementary effects.
    Morris,
    /// The middle, and each factor low and high.
    OneAtATime,
}

impl DesignKind {
    pub(crate) const ALL: [Self; 8] = [
        Self::Factorial,
        Self::Zipped,
        Self::LatinHypercube,
        Self::Sobol,
        Self::Random,
        Self::Saltelli,
        Self::Morris,
        Self::OneAtATime,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Factorial => "factorial",
            Self::Zipped => "zipped",
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
            Self::Random => "random",
            Self::Saltelli => "saltelli",
            Self::Morris => "morris",
            Self::OneAtATime => "one-at-a-time",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// How distributions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Latin hypercube.
    LatinHypercube,
    /// Sobol sequence with a random shift of its digits.
    Sobol,
    /// Independent draws.
    Random,
}

impl Sampling {
    pub(crate) const ALL: [Self; 3] = [Self::LatinHypercube, Self::Sobol, Self::Random];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
            Self::Random => "random",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// How a fragility curve is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FragilityMethod {
    /// Maximum likelihood of the outcomes.
    MultipleStripe,
    /// Straight line through the logarithms of demand and intensity; demands of zero are left out.
    Cloud,
    /// The same, with logistic regressions for demands of zero and for collapse.
    ModifiedCloud,
}

impl FragilityMethod {
    pub(crate) const ALL: [Self; 3] = [Self::MultipleStripe, Self::Cloud, Self::ModifiedCloud];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::MultipleStripe => "stripes",
            Self::Cloud => "cloud",
            Self::ModifiedCloud => "modified-cloud",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// Time integration rules by name; their numbers are keys of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IntegratorMethod {
    AverageAcceleration,
    Newmark,
    Hht,
    GeneralizedAlpha,
}

impl IntegratorMethod {
    pub(crate) const ALL: [Self; 4] = [
        Self::AverageAcceleration,
        Self::Newmark,
        Self::Hht,
        Self::GeneralizedAlpha,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::AverageAcceleration => "average-acceleration",
            Self::Newmark => "newmark",
            Self::Hht => "hht",
            Self::GeneralizedAlpha => "generalized-alpha",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

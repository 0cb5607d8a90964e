//! The solver's report: numbers about a solution, told to users and judged by the diagnostics.
//!
//! It is kept in a dataset as the named records of a step's history. Names and order are in one
//! table here; nothing else knows them.

use ppum::dataset::{Record, Step};
use ppum::progress::Phase;
use ppum::vec2::Vec2;

/// The numbers of a solution. Those of a dataset that another program made, or a step that nobody
/// has solved, may be missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolverReport {
    /// Number of patches that hold several runs of one crack or rim, and so glue two parts of the
    /// body together: smaller cells are needed there.
    pub crossed_twice: Option<u64>,
    /// Unknowns before the cut-off.
    pub unknowns: Option<u64>,
    /// Unknowns that the stable basis has cut off.
    pub cut_off: Option<u64>,
    /// Relative residual ‖f − K u‖ / ‖f‖ in the stable basis.
    pub residual: Option<f64>,
    /// Unknowns left out because they depend on those of other patches.
    pub dependent: Option<u64>,
    /// The linear solver.
    pub solver: Option<LinearKind>,
    /// Bytes that the linear solver has held: matrices of all levels, factors.
    pub solver_bytes: Option<u64>,
    /// True if the direct solver took the place of the multilevel one, whose levels did not serve.
    pub fallback: bool,
    /// Levels of the multilevel solver, the finest and the coarsest among them.
    pub solver_levels: Option<u64>,
    /// Its steps, of the solution without those of other right-hand sides.
    pub iterations: Option<u64>,
    /// Condition of the system with its preconditioner, estimated from the steps: a bound
    /// from below.
    pub preconditioned_condition: Option<f64>,
    /// Largest penalty β of Nitsche's method in a cell, in units of stiffness over cell width: 3 to
    /// 36 in whole cells and more in slivers.
    pub nitsche: Option<f64>,
    /// Pieces that cracks and holes cut the body into.
    pub pieces: Option<u64>,
    /// Rigid-body modes of the pieces that nothing holds.
    pub free_modes: Option<u64>,
    /// Largest part of the loads on a piece that does not balance.
    pub imbalance: Option<f64>,
    /// Systems that were solved until the faces that touch came to rest; zero where none do.
    pub contact_steps: Option<u64>,
    /// Part of the faces that may touch that is closed.
    pub closed: Option<f64>,
    /// Largest overlap of faces that may touch.
    pub overlap: Option<f64>,
    /// Largest tensile stress between closed faces.
    pub tension: Option<f64>,
    /// Quadrature points of the system's integrals.
    pub quadrature_points: Option<u64>,
    /// Energy of the solution, ½ ∫ σ:ε or ½ ∫ κ |∇u|²; infinite with forces at points.
    pub energy: Option<f64>,
    /// Energy of the whole body, of which one with a crack on an edge is a half or a quarter.
    pub whole_energy: Option<f64>,
    /// Estimated error of the solution in the energy norm, as a part of the norm of the solution.
    pub estimated_error: Option<f64>,
    /// Largest estimated error of the stress intensity factors of a tip, as a part of their size.
    pub factor_error: Option<f64>,
    /// The reason that ended the adaptation.
    pub stop: Option<StopReason>,
    /// Relative error of stresses evaluated in double precision.
    pub rounding: Option<f64>,
    /// Seconds of each phase, in the order of the work.
    pub seconds: Vec<(Phase, f64)>,
    /// Bytes of what a phase makes and keeps for the next ones; of phases that keep nothing none.
    pub bytes: Vec<(Phase, f64)>,
    /// Unknowns that a phase works with: all, those that the cut-off leaves, those that are
    /// solved for.
    pub worked: Vec<(Phase, f64)>,
    /// The levels of the multilevel solver, the finest first.
    pub levels: Vec<LevelSize>,
    /// The residual before the first step of the multilevel solver and after each, in the norm of
    /// the preconditioner and as a part of the first.
    pub residuals: Vec<f64>,
    /// Before each step, the residual that reaches each level, the finest first, as a part of that
    /// of the first step.
    pub level_residuals: Vec<Vec<f64>>,
    /// Integrands that quadrature does not resolve; a history has no records of them.
    pub unresolved: Vec<UnresolvedIntegrand>,
}

/// The size of a level of the multilevel solver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevelSize {
    /// Patches.
    pub patches: f64,
    /// Unknowns.
    pub unknowns: f64,
    /// Values of its matrix that are stored, about one half of all.
    pub values: f64,
    /// Bytes of its matrix with the inverses or the factor, and of the way to the next
    /// coarser level.
    pub bytes: f64,
}

/// A number of a level by its unit in files.
type OfLevel = (&'static str, fn(&mut LevelSize) -> &mut f64);

impl LevelSize {
    /// All numbers.
    const NUMBERS: [OfLevel; 4] = [
        ("patches", |l| &mut l.patches),
        (UNKNOWNS, |l| &mut l.unknowns),
        ("values", |l| &mut l.values),
        (BYTE, |l| &mut l.bytes),
    ];
}

/// A value of the report as the number of a record.
trait HistoryNumber {
    /// The number; none if there is no record.
    fn number(&self) -> Option<f64>;

    /// Takes up a number, unless there was one before.
    fn take_up(&mut self, number: f64);
}

impl HistoryNumber for Option<f64> {
    fn number(&self) -> Option<f64> {
        *self
    }

    fn take_up(&mut self, number: f64) {
        self.get_or_insert(number);
    }
}

impl HistoryNumber for Option<u64> {
    fn number(&self) -> Option<f64> {
        self.map(|count| count as f64)
    }

    fn take_up(&mut self, number: f64) {
        *self = self.or((number >= 0.0 && number.fract() == 0.0).then_some(number as u64));
    }
}

impl HistoryNumber for bool {
    fn number(&self) -> Option<f64> {
        self.then_some(1.0)
    }

    fn take_up(&mut self, number: f64) {
        *self |= number == 1.0;
    }
}

macro_rules! coded {
    ($($(#[$doc:meta])* $kind:ident { $($(#[$of:meta])* $value:ident $word:literal,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $kind { $($(#[$of])* $value,)* }

        impl $kind {
            const WORDS: &[(Self, &'static str)] = &[$((Self::$value, $word)),*];

            /// A word for it, that of problem files where they have one.
            #[must_use]
            pub fn word(self) -> &'static str {
                Self::WORDS[self as usize].1
            }
        }

        impl HistoryNumber for Option<$kind> {
            fn number(&self) -> Option<f64> {
                self.map(|kind| f64::from(kind as u8 + 1))
            }

            fn take_up(&mut self, number: f64) {
                let mut all = $kind::WORDS.iter().map(|(kind, _)| Some(*kind));
                *self = self.or_else(|| all.find(|kind| kind.number() == Some(number))?);
            }
        }
    )*};
}

coded! {
    /// A solver of linear systems; in a dataset's history it is a number, from 1.
    LinearKind {
        /// Sparse Cholesky factorisation.
        Direct "direct",
        /// Conjugate gradients with coarser levels.
        Multilevel "multilevel",
    }

    /// The reason why an adaptation ended; in a dataset's history it is a number, from 1.
    StopReason {
        /// The estimated error is as small as wanted.
        Tolerance "tolerance",
        /// As many steps were made as wanted.
        Steps "steps",
        /// The next step would have more unknowns than wanted.
        Unknowns "max_unknowns",
        /// The memory does not hold the next step.
        Memory "memory",
        /// No cell that is to be improved can be divided, and no order raised.
        Limits "limits",
    }
}

/// A number of the report by its name in files: its value, and how it is taken up if it is the
/// first of its name.
type ReportEntry = (&'static str, fn(&SolverReport) -> Option<f64>, fn(&mut SolverReport, f64));

macro_rules! entries {
    ($($name:expr => $field:ident,)*) => {
        [$((
            $name,
            |report| report.$field.number(),
            |report, value| report.$field.take_up(value),
        )),*]
    };
}

/// All numbers but the seconds, in the order of files.
const ENTRIES: [ReportEntry; 26] = entries![
    "crossed twice" => crossed_twice,
    "unknowns" => unknowns,
    "cut-off" => cut_off,
    "residual" => residual,
    "dependent" => dependent,
    SOLVER => solver,
    BYTES => solver_bytes,
    "solver fallback" => fallback,
    "solver levels" => solver_levels,
    "iterations" => iterations,
    "preconditioned condition" => preconditioned_condition,
    "nitsche" => nitsche,
    "pieces" => pieces,
    "free motions" => free_modes,
    "imbalance" => imbalance,
    "quadrature points" => quadrature_points,
    "energy" => energy,
    WHOLE_ENERGY => whole_energy,
    "estimated error" => estimated_error,
    "estimated error of factors" => factor_error,
    STOP => stop,
    "rounding" => rounding,
    "contact steps" => contact_steps,
    "closed faces" => closed,
    "overlap of faces" => overlap,
    "tension between faces" => tension,
];

/// The record of the energy of the whole.
const WHOLE_ENERGY: &str = "energy of the whole";

/// The records of energies, which grow with the square of the loads.
pub const ENERGIES: [&str; 2] = ["energy", WHOLE_ENERGY];

/// The records whose values are codes.
const SOLVER: &str = "linear solver";
const STOP: &str = "adaptation stop";

/// The record with the unit `B`.
const BYTES: &str = "solver memory";

/// The prefix of records of the iterations' residuals: `iteration 7`, `iteration 7 level 2`.
const ITERATION: &str = "iteration ";

/// The prefix of records of levels: `level 2`.
const LEVEL: &str = "level ";

/// The iteration that a name tells, and the level if it tells one.
fn iteration_of(name: &str) -> Option<(usize, Option<usize>)> {
    let place = name.strip_prefix(ITERATION)?;
    match place.split_once(" level ") {
        Some((step, level)) => Some((step.parse().ok()?, Some(level.parse().ok()?))),
        None => Some((place.parse().ok()?, None)),
    }
}

/// The level that a name tells.
fn level_of(name: &str) -> Option<usize> {
    name.strip_prefix(LEVEL)?.parse().ok()
}

/// Units of records of phases and levels.
const SECOND: &str = "s";
const BYTE: &str = "B";
const UNKNOWNS: &str = "unknowns";

/// The attribute with the seconds that one core took for the cell of each patch in the assembly.
pub const ASSEMBLY_SECONDS: &str = "assembly-seconds";

/// True for names of records of the convergence history, of which there are many.
#[must_use]
pub fn is_convergence_record(name: &str) -> bool {
    iteration_of(name).is_some()
}

/// True for records of the sizes of levels.
#[must_use]
pub fn is_of_level(record: &Record) -> bool {
    let units = LevelSize::NUMBERS.map(|(unit, _)| unit);
    level_of(&record.name).is_some() && units.contains(&record.unit.as_str())
}

/// True for records of a phase: its seconds, bytes and unknowns.
#[must_use]
pub fn is_of_phase(record: &Record) -> bool {
    let units = [SECOND, BYTE, UNKNOWNS];
    phase_of(record).is_some() && units.contains(&record.unit.as_str())
}

/// Removes the seconds from a step: all else is the same whenever and on however many threads it
/// is solved.
pub fn strip_timings(step: &mut Step) {
    step.history.retain(|record| record.unit != SECOND);
    step.attributes.retain(|attribute| attribute.name != ASSEMBLY_SECONDS);
}

/// The word that a record's value stands for, if it is a code.
#[must_use]
pub fn word(name: &str, value: f64) -> Option<&'static str> {
    let mut report = SolverReport::default();
    match name {
        SOLVER => report.solver.take_up(value),
        STOP => report.stop.take_up(value),
        _ => {}
    }
    report.solver.map(LinearKind::word).or(report.stop.map(StopReason::word))
}

/// Phases of a solution; their times are records with the unit `s`, others with `B` and `unknowns`.
const PHASES: [Phase; 6] = [
    Phase::Cover,
    Phase::Basis,
    Phase::Assembly,
    Phase::Solution,
    Phase::Intensity,
    Phase::Estimation,
];

/// The phase that a record is called by.
fn phase_of(record: &Record) -> Option<Phase> {
    PHASES.into_iter().find(|phase| phase.name() == record.name)
}

impl SolverReport {
    /// The report in a step's history. If several records have one name, the first counts; those of
    /// other names are left out.
    #[must_use]
    pub fn of(history: &[Record]) -> Self {
        let mut report = Self::default();
        for record in history {
            if let Some(phase) = phase_of(record).filter(|_| is_of_phase(record)) {
                report.of_phases(&record.unit).push((phase, record.value));
            } else if is_of_level(record) {
                report.add_level(record);
            } else if let Some(place) = iteration_of(&record.name) {
                report.add_residual(place, record.value);
            } else if let Some((.., take)) = ENTRIES.iter().find(|(name, ..)| *name == record.name)
            {
                take(&mut report, record.value);
            }
        }
        report
    }

    /// The records of a step's history: the way back of [`SolverReport::of`].
    #[must_use]
    pub fn records(&self) -> Vec<Record> {
        let mut report = self.clone();
        let record =
            |name: &str, value, unit: &str| Record { name: name.into(), value, unit: unit.into() };
        let numbers = ENTRIES.iter().filter_map(|(name, value, _)| {
            Some(record(name, value(self)?, if *name == BYTES { BYTE } else { "" }))
        });
        let mut records: Vec<_> = numbers.collect();
        for unit in [SECOND, BYTE, UNKNOWNS] {
            let of_phases = report.of_phases(unit).iter();
            records.extend(of_phases.map(|(phase, value)| record(phase.name(), *value, unit)));
        }
        for (l, size) in report.levels.iter_mut().enumerate() {
            let number =
                |(unit, number): OfLevel| record(&format!("{LEVEL}{l}"), *number(size), unit);
            records.extend(LevelSize::NUMBERS.map(number));
        }
        for (step, residual) in self.residuals.iter().enumerate() {
            records.push(record(&format!("{ITERATION}{step}"), *residual, ""));
            let of_levels = self.level_residuals.get(step).into_iter().flatten().enumerate();
            let of_levels = of_levels
                .map(|(l, value)| record(&format!("{ITERATION}{step} level {l}"), *value, ""));
            records.extend(of_levels);
        }
        records
    }

    /// The numbers of phases with a unit.
    fn of_phases(&mut self, unit: &str) -> &mut Vec<(Phase, f64)> {
        match unit {
            SECOND => &mut self.seconds,
            BYTE => &mut self.bytes,
            _ => &mut self.worked,
        }
    }

    /// Takes a number of a level up if it is one of the last level or the first one of the next.
    fn add_level(&mut self, record: &Record) {
        let level = level_of(&record.name);
        if level == Some(self.levels.len()) && record.unit == LevelSize::NUMBERS[0].0 {
            self.levels.push(LevelSize::default());
        }
        let of_level = level.and_then(|l| self.levels.get_mut(l));
        let number = LevelSize::NUMBERS.iter().find(|(unit, _)| *unit == record.unit);
        if let Some((level, (_, number))) = of_level.zip(number) {
            *number(level) = record.value;
        }
    }

    /// Takes a residual of the course up if it is the next one.
    fn add_residual(&mut self, (step, level): (usize, Option<usize>), value: f64) {
        match level {
            None if step == self.residuals.len() => self.residuals.push(value),
            None => {}
            Some(level) => {
                if step == self.level_residuals.len() {
                    self.level_residuals.push(Vec::new());
                }
                let of_step = self.level_residuals.get_mut(step);
                let next = of_step.filter(|values| values.len() == level);
                next.into_iter().for_each(|values| values.push(value));
            }
        }
    }

    /// Part of the unknowns that was cut off.
    pub fn cut_off_part(&self) -> Option<f64> {
        Some(self.cut_off? as f64 / self.unknowns? as f64)
    }
}

/// An integrand that quadrature does not resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct UnresolvedIntegrand {
    /// The load that it is, in words; none for functions of the space and coefficients.
    pub load: Option<String>,
    /// Estimated error: of a load that of its resultant as a part of its magnitude, of functions
    /// that of their integrals over a piece of a cell.
    pub error: f64,
    /// The place of most of it.
    pub at: Vec2,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A report with another number in each field.
    fn every_number() -> SolverReport {
        SolverReport {
            crossed_twice: Some(1),
            unknowns: Some(20),
            cut_off: Some(3),
            residual: Some(0.25),
            dependent: Some(5),
            solver: Some(LinearKind::Multilevel),
            solver_bytes: Some(700),
            fallback: true,
            solver_levels: Some(9),
            iterations: Some(10),
            preconditioned_condition: Some(11.5),
            nitsche: Some(12.5),
            pieces: Some(13),
            free_modes: Some(14),
            imbalance: Some(0.125),
            quadrature_points: Some(16),
            energy: Some(17.5),
            whole_energy: Some(18.5),
            estimated_error: Some(19.5),
            factor_error: Some(20.5),
            stop: Some(StopReason::Memory),
            rounding: Some(22.5),
            contact_steps: Some(23),
            closed: Some(0.75),
            overlap: Some(25.5),
            tension: Some(26.5),
            ..SolverReport::default()
        }
    }

    /// Its records, as files have had them.
    const NUMBERS: [(&str, f64); 26] = [
        ("crossed twice", 1.0),
        ("unknowns", 20.0),
        ("cut-off", 3.0),
        ("residual", 0.25),
        ("dependent", 5.0),
        ("linear solver", 2.0),
        ("solver memory", 700.0),
        ("solver fallback", 1.0),
        ("solver levels", 9.0),
        ("iterations", 10.0),
        ("preconditioned condition", 11.5),
        ("nitsche", 12.5),
        ("pieces", 13.0),
        ("free motions", 14.0),
        ("imbalance", 0.125),
        ("quadrature points", 16.0),
        ("energy", 17.5),
        ("energy of the whole", 18.5),
        ("estimated error", 19.5),
        ("estimated error of factors", 20.5),
        ("adaptation stop", 4.0),
        ("rounding", 22.5),
        ("contact steps", 23.0),
        ("closed faces", 0.75),
        ("overlap of faces", 25.5),
        ("tension between faces", 26.5),
    ];

    #[test]
    fn reports_come_back_from_records() {
        let mut report = every_number();
        report.seconds = PHASES.iter().map(|&phase| (phase, 0.5)).collect();
        report.bytes = vec![(Phase::Basis, 80.0), (Phase::Assembly, 96.0)];
        report.worked = vec![(Phase::Cover, 7.0), (Phase::Basis, 5.0)];
        let size =
            |n: f64| LevelSize { patches: n, unknowns: 2.0 * n, values: 9.0 * n, bytes: 72.0 };
        report.levels = vec![size(16.0), size(4.0)];
        (report.residuals, report.level_residuals) =
            (vec![1.0, 0.25], vec![vec![1.0, 1.0], vec![0.5, 0.125]]);
        let mut records = report.records();
        assert_eq!(records.len(), ENTRIES.len() + PHASES.len() + 4 + 8 + 6);
        assert_eq!(records.iter().filter(|record| is_of_phase(record)).count(), PHASES.len() + 4);
        assert_eq!(records.iter().filter(|record| is_of_level(record)).count(), 8);
        assert_eq!(records.iter().filter(|record| is_convergence_record(&record.name)).count(), 6);
        for (record, (name, value)) in records.iter().zip(NUMBERS) {
            assert_eq!((record.name.as_str(), record.value), (name, value));
        }
        assert_eq!(SolverReport::of(&records), report);
        // a second record of a name, and names of other programs
        for (name, unit) in [
            ("energy", ""),
            ("mood", ""),
            ("cover", ""),
            ("iteration 1", ""),
            ("iteration x", ""),
            ("level 7", "patches"),
            ("level 2", "unknowns"),
            ("level 0", "mood"),
            ("level x", "B"),
        ] {
            records.push(Record { name: name.into(), value: -1.0, unit: unit.into() });
        }
        assert_eq!(SolverReport::of(&records), report);
    }

    /// Seconds are forgotten, in both places, and nothing else.
    #[test]
    fn times_are_forgotten() {
        use ppum::dataset::Attribute;
        let cover = ppum::cover::Cover::uniform(
            ppum::vec2::Rect::new(Vec2::ZERO, ppum::vec2::vec2(1.0, 1.0)),
            0,
        );
        let weight = ppum::weight::WeightFunction::Linear;
        let mut step = Step::new(cover.and_then(|c| c.partition(1.3, weight)).expect("a cover"));
        let attribute = |name: &str| Attribute { name: name.into(), values: vec![1.0] };
        step.attributes = vec![attribute("order"), attribute(ASSEMBLY_SECONDS)];
        let report = SolverReport {
            seconds: vec![(Phase::Cover, 1.0)],
            bytes: vec![(Phase::Cover, 8.0)],
            energy: Some(2.0),
            ..SolverReport::default()
        };
        step.history = report.records();
        strip_timings(&mut step);
        assert_eq!(step.attributes, [attribute("order")]);
        let left = SolverReport { seconds: Vec::new(), ..report };
        assert_eq!(step.history, left.records());
    }

    #[test]
    fn what_is_missing_stays_missing() {
        assert_eq!(SolverReport::of(&[]), SolverReport::default());
        assert_eq!(SolverReport::default().records(), []);
        assert_eq!(
            SolverReport { cut_off: Some(1), ..SolverReport::default() }.cut_off_part(),
            None
        );
    }
}

//! Groups of functions: what a shader evaluates at once.
//!
//! A group has up to four functions that follow each other in the step's table and share a frame,
//! or one side of a crack, one indicator of a component, or the function 1. The dataset's data name
//! functions by group and entry, so groups are made once, at upload. A function that is replaced
//! stays in its group: frames and kernels follow the table at hand, the data stay.

use std::collections::BTreeMap;

use ppum::crack::TipId;
use ppum::decompose::FieldPart;
use ppum::function::{Frame, Function, FunctionKind, GROUP, WESTERGAARD};
use ppum::vec2::Vec2;

/// The frame that the functions of a group are measured in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GroupFrame {
    /// The function 1.
    One,
    /// The side of a crack, by its index.
    Side(u32),
    /// The indicator of a component, by the index of its function.
    Indicator(u32),
    /// World coordinates.
    World,
    /// A fixed origin and x axis.
    Fixed {
        /// Origin.
        origin: Vec2,
        /// Angle of the x axis, radians.
        angle: f64,
    },
    /// A crack tip.
    Tip(TipId),
}

/// The group of the function 1, if there is one.
pub(crate) const SMOOTH_GROUP: u32 = 0;

/// The groups of a step's functions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FunctionGroups {
    /// Group and entry of each function.
    slots: Vec<[u32; 2]>,
    /// The functions of each group, ascending.
    members: Vec<Vec<u32>>,
    classes: Vec<Class>,
}

/// The part of a solution that a group belongs to, for images of one part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// f = 1.
    Smooth,
    /// The side of a crack, the indicator of a component.
    Jump,
    /// Formulas in the frame of a tip.
    Tip,
    /// Other formulas.
    Other,
}

impl FunctionGroups {
    /// Groups the functions of a step as they are at upload.
    ///
    /// Groups of one class, and of the same formulas, follow each other, so that a shader finds the
    /// kernel of a group by few comparisons.
    pub(crate) fn new(functions: &[Function]) -> Self {
        let mut members = consecutive(functions);
        let mut kernels = BTreeMap::new();
        let kernel: Vec<usize> = members
            .iter()
            .map(|members| {
                let new = kernels.len();
                *kernels.entry(texts(functions, members)).or_insert(new)
            })
            .collect();
        let mut order: Vec<usize> = (0..members.len()).collect();
        order.sort_by_key(|&group| (class(&functions[members[group][0] as usize]), kernel[group]));
        members = order.into_iter().map(|group| std::mem::take(&mut members[group])).collect();
        let mut slots = vec![[0; 2]; functions.len()];
        for (group, members) in (0..).zip(&members) {
            for (entry, &function) in (0..).zip(members) {
                slots[function as usize] = [group, entry];
            }
        }
        let classes = members.iter().map(|members| class(&functions[members[0] as usize]));
        Self { slots, classes: classes.collect(), members }
    }

    /// Number of groups.
    pub(crate) fn count(&self) -> usize {
        self.members.len()
    }

    /// True if the step has the function 1, and so a [`SMOOTH_GROUP`].
    pub(crate) fn has_smooth(&self) -> bool {
        self.classes.first() == Some(&Class::Smooth)
    }

    /// Number of functions.
    pub(crate) fn functions(&self) -> usize {
        self.slots.len()
    }

    /// Group and entry of a function.
    pub(crate) fn slot(&self, function: u32) -> [u32; 2] {
        self.slots[function as usize]
    }

    /// The functions of a group by their indices in the table.
    pub(crate) fn members(&self, group: usize) -> &[u32] {
        &self.members[group]
    }

    /// The class of each group at upload: a smooth part with another function in place of 1 is
    /// still the smooth part.
    #[cfg(test)]
    pub(crate) fn classes(&self) -> &[Class] {
        &self.classes
    }

    /// The frame of each group, with a table in which functions may be replaced.
    pub(crate) fn frames(&self, functions: &[Function]) -> Vec<GroupFrame> {
        self.members.iter().map(|members| frame(members[0], functions)).collect()
    }
}

/// Functions that follow each other and can be evaluated at once.
fn consecutive(functions: &[Function]) -> Vec<Vec<u32>> {
    let mut groups: Vec<Vec<u32>> = Vec::new();
    for (index, function) in (0..).zip(functions) {
        match groups.last_mut() {
            Some(last) if joins(&functions[last[0] as usize], function, last.len()) => {
                last.push(index);
            }
            _ => groups.push(vec![index]),
        }
    }
    groups
}

/// True if a function can stand in a group with this first function and this many members. The
/// Westergaard functions begin a group, so that all four share one.
fn joins(first: &Function, function: &Function, members: usize) -> bool {
    let (FunctionKind::Formula { frame: a, .. }, FunctionKind::Formula { frame: b, text, .. }) =
        (&first.kind, &function.kind)
    else {
        return false;
    };
    a == b && members < GROUP && text != WESTERGAARD[0]
}

fn class(function: &Function) -> Class {
    match FieldPart::of(&function.kind) {
        FieldPart::Smooth => Class::Smooth,
        FieldPart::Jump => Class::Jump,
        FieldPart::Tip => Class::Tip,
        FieldPart::Other | FieldPart::Patch(_) => Class::Other,
    }
}

fn frame(index: u32, functions: &[Function]) -> GroupFrame {
    match functions[index as usize].kind {
        FunctionKind::Side { crack } => GroupFrame::Side(crack),
        FunctionKind::Component { .. } => GroupFrame::Indicator(index),
        FunctionKind::Formula { frame: Frame::World, .. } => GroupFrame::World,
        FunctionKind::Formula { frame: Frame::Fixed { origin, angle }, .. } => {
            GroupFrame::Fixed { origin, angle }
        }
        FunctionKind::Formula { frame: Frame::Tip(tip), .. } => GroupFrame::Tip(tip),
        _ => GroupFrame::One,
    }
}

/// Texts and parameters of formulas, a mark of indicators: groups that differ in their kernels have
/// different ones.
pub(crate) fn texts(functions: &[Function], members: &[u32]) -> String {
    let text = |&member: &u32| match &functions[member as usize].kind {
        FunctionKind::Formula { text, parameters, .. } => {
            let values = parameters.iter().map(|(name, v)| format!("{name}={:x}\0", v.to_bits()));
            format!("{text}\0{}\0", values.collect::<String>())
        }
        FunctionKind::Component { .. } => "\0".to_owned(),
        _ => String::new(),
    };
    members.iter().map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::{End, SegmentId, TipId};
    use ppum::function::{Cut, CutBranch};
    use ppum::vec2::Vec2;
    use ppum_testkit::synthetic::Recipe;

    fn formula(text: &str, frame: Frame) -> Function {
        Function { name: text.to_owned(), kind: FunctionKind::formula(text, frame) }
    }

    const TIP: TipId = TipId { crack: 0, end: End::Last };

    #[test]
    fn functions_that_follow_each_other_share_a_group() {
        let tip = Frame::Tip(TIP);
        let mut functions = vec![formula("x", tip), formula("y", tip)];
        functions.extend(WESTERGAARD.map(|text| formula(text, tip)));
        functions.push(formula("r", tip));
        functions.extend((0..5).map(|_| formula("x", Frame::World)));
        functions.push(Function { name: "one".into(), kind: FunctionKind::One });
        functions.push(Function { name: "side".into(), kind: FunctionKind::Side { crack: 0 } });
        let groups = FunctionGroups::new(&functions);
        let members: Vec<_> = (0..groups.count()).map(|group| groups.members(group)).collect();
        let expected: [&[u32]; 7] =
            [&[12], &[13], &[0, 1], &[2, 3, 4, 5], &[6], &[7, 8, 9, 10], &[11]];
        assert_eq!(members, expected);
        use Class::{Jump, Other, Smooth, Tip};
        assert_eq!(groups.classes(), [Smooth, Jump, Tip, Tip, Tip, Other, Other]);
        for function in 0..functions.len() as u32 {
            let [group, entry] = groups.slot(function);
            assert_eq!(groups.members(group as usize)[entry as usize], function);
        }
    }

    /// Tips, sides and components in turn, as a solver may list them: still one run of each kernel.
    #[test]
    fn like_groups_follow_each_other() {
        let mut functions = Vec::new();
        let (segment, [left, right]) =
            (SegmentId { crack: 0, segment: 0 }, [CutBranch::Inside, CutBranch::Outside]);
        for crack in 0..9 {
            functions.push(Function { name: "side".into(), kind: FunctionKind::Side { crack } });
            let cuts = vec![Cut { segment, left, right }];
            functions.push(Function { name: "in".into(), kind: FunctionKind::Component { cuts } });
            for end in [End::Start, End::Last] {
                let frame = Frame::Tip(TipId { crack, end });
                functions.extend(WESTERGAARD.map(|text| formula(text, frame)));
                functions.push(formula("r", frame));
            }
        }
        let groups = FunctionGroups::new(&functions);
        assert_eq!(groups.count(), 9 + 9 + 18 + 18);
        assert_eq!(groups.classes()[..18], [Class::Jump; 18]);
        let keys: Vec<_> =
            (0..groups.count()).map(|group| texts(&functions, groups.members(group))).collect();
        assert_eq!(keys.windows(2).filter(|pair| pair[0] != pair[1]).count(), 3);
    }

    #[test]
    fn replaced_functions_stay_in_their_groups() {
        let mut step = Recipe::default().dataset().steps.remove(0);
        let groups = FunctionGroups::new(&step.functions);
        let before = groups.frames(&step.functions);
        let side = before.iter().position(|frame| matches!(frame, GroupFrame::Side(0)));
        let side = side.expect("a crack");
        assert_eq!(before[0], GroupFrame::One);
        let name = |group: usize| step.functions[groups.members(group)[0] as usize].name.clone();
        let names = [name(0), name(side)];
        for name in names {
            step.replace_function(&name, "x + 1", &[]).expect("a formula");
        }
        step.replace_function(WESTERGAARD[0], "r", &[]).expect("a formula");
        let after = groups.frames(&step.functions);
        for (group, (before, after)) in before.iter().zip(&after).enumerate() {
            let replaced = group == 0 || group == side;
            assert_eq!(*after, if replaced { GroupFrame::World } else { *before });
        }
        assert_eq!(groups.classes()[0], Class::Smooth);
    }

    #[test]
    fn frames_that_differ_do_not_share_a_group() {
        let fixed = |angle| formula("x", Frame::Fixed { origin: Vec2::ZERO, angle });
        let groups = FunctionGroups::new(&[fixed(0.0), fixed(0.5), formula("x", Frame::World)]);
        assert_eq!(groups.count(), 3);
    }
}

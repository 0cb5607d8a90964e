//! Arithmetic on vectors outside of kernels, read from the object code of the program that runs.
//!
//! Kernels are entered with an instruction set by functions of `fearless_simd`, into which all of
//! their arithmetic is inlined. Code that is not inlined is compiled for the set that every
//! processor has: each sum and product of vectors in it is a call of a function of `fearless_simd`.
//! So the functions that make such calls are those that have left their set.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::Context as _;
use iced_x86::{Decoder, DecoderOptions, Mnemonic, OpKind};
use object::{File, Object as _, ObjectSection as _, ObjectSymbol as _, SectionKind};
use serde::Serialize;

use crate::table::ReportTable;

/// Instruction sets, and what symbols call them.
const SETS: [(&str, &str); 2] = [("AVX2", "avx2"), ("AVX-512", "avx512")];

/// The function that enters a set, and an operation on vectors.
const ENTRANCE: &str = "vectorize_";
const OPERATION: &str = "__fearless_simd_kernel";

/// The only other crate that computes on such vectors; it is not optimised.
const FOREIGN: &str = "vello_";

/// The calls of an instruction set.
#[derive(Debug, Serialize)]
pub(crate) struct Calls {
    set: &'static str,
    kernels: usize,
    /// Functions that compute on vectors outside of kernels, and their calls.
    outside: BTreeMap<String, usize>,
}

impl Calls {
    /// Those of the program that runs; none where it is no ELF file for x86-64 with symbols.
    ///
    /// # Errors
    /// If the program cannot be read.
    pub(crate) fn of_this_program() -> anyhow::Result<Vec<Self>> {
        if !cfg!(all(target_arch = "x86_64", target_os = "linux")) {
            return Ok(Vec::new());
        }
        let path = std::env::current_exe()?;
        let bytes = std::fs::read(&path).with_context(|| path.display().to_string())?;
        let code = Code::new(File::parse(&*bytes)?);
        Ok(SETS.iter().filter_map(|&(set, symbol)| code.calls(set, symbol)).collect())
    }

    /// Lists the faults, beside the control, which is meant to have some.
    pub(crate) fn mistakes(&self, control: &str) -> Vec<String> {
        let Self { set, outside, .. } = self;
        let (controls, others): (Vec<_>, Vec<_>) =
            outside.keys().partition(|name| name.contains(control));
        let told =
            |name: &&String| format!("{name} computes on vectors of {set} and is not inlined");
        let mut mistakes: Vec<String> = others.iter().map(told).collect();
        if controls.is_empty() {
            mistakes.push(format!("the control is not seen with {set}"));
        }
        mistakes
    }
}

/// The calls of all sets as a table.
pub(crate) fn table(calls: &[Calls]) -> ReportTable {
    let row = |calls: &Calls| {
        let numbers = [calls.kernels, calls.outside.len(), calls.outside.values().sum()];
        [calls.set.to_owned()].into_iter().chain(numbers.map(|n| n.to_string())).collect()
    };
    let head = ["instructions", "kernels", "functions outside", "their calls"];
    ReportTable {
        title: "Arithmetic on vectors outside of kernels".to_owned(),
        words: 1,
        head: head.map(str::to_owned).into(),
        rows: calls.iter().map(row).collect(),
        note: "Counted in the object code; the control alone should be outside.".to_owned(),
    }
}

/// The functions of a program: sizes and names, by address.
struct Code<'d> {
    file: File<'d>,
    functions: BTreeMap<u64, (u64, &'d str)>,
}

impl<'d> Code<'d> {
    fn new(file: File<'d>) -> Self {
        let symbols = file.symbols().filter(|symbol| symbol.size() > 0);
        let named = symbols.filter_map(|s| Some((s.address(), (s.size(), s.name().ok()?))));
        let functions = named.collect();
        Self { file, functions }
    }

    /// The calls of a set, if there are kernels of it.
    fn calls(&self, set: &'static str, symbol: &str) -> Option<Calls> {
        let is_of_set = |name: &str| name.contains(symbol);
        let entrance = |name: &str| name.contains(ENTRANCE);
        let all = || self.functions.iter().map(|(&address, &(_, name))| (address, name));
        let operation = |(_, name): &(u64, &str)| name.contains(OPERATION) && is_of_set(name);
        let operations: BTreeSet<u64> =
            all().filter(operation).map(|(address, _)| address).collect();
        let kernels = all().filter(|(_, name)| entrance(name) && is_of_set(name)).count();
        let others = all().filter(|(_, name)| !entrance(name) && !name.contains(FOREIGN));
        let outside = others
            .map(|(address, name)| (name.to_owned(), self.count(address, &operations)))
            .filter(|&(_, calls)| calls > 0);
        (kernels > 0).then(|| Calls { set, kernels, outside: outside.collect() })
    }

    /// How often a function calls, jumps to or takes the address of some others.
    fn count(&self, address: u64, others: &BTreeSet<u64>) -> usize {
        let Some(bytes) = self.bytes(address) else { return 0 };
        let mut decoder = Decoder::with_ip(64, bytes, address, DecoderOptions::NONE);
        let instructions = decoder.iter().filter(|instruction| {
            let target = match (instruction.mnemonic(), instruction.op0_kind()) {
                (Mnemonic::Call | Mnemonic::Jmp, OpKind::NearBranch64) => {
                    instruction.near_branch_target()
                }
                (Mnemonic::Lea, _) if instruction.is_ip_rel_memory_operand() => {
                    instruction.ip_rel_memory_address()
                }
                _ => return false,
            };
            others.contains(&target)
        });
        instructions.count()
    }

    fn bytes(&self, address: u64) -> Option<&'d [u8]> {
        let size = self.functions.get(&address)?.0;
        let within = |start: u64, length: u64| start <= address && address + size <= start + length;
        let is_code = |section: &object::Section| section.kind() == SectionKind::Text;
        let mut sections = self.file.sections().filter(is_code);
        let section = sections.find(|s| within(s.address(), s.size()))?;
        section.data_range(address, size).ok()?
    }
}

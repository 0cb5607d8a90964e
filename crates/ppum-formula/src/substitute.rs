//! Inputs replaced by formulas.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::derivative::DerivativeError;
use crate::formula::Formula;
use crate::graph::Graph;
use crate::limits::MAX_NODES;
use crate::program::FormulaProgram;

impl Formula {
    /// The formula with definitions in place of some of its inputs: pairs of an input's name and a
    /// formula of the same scope, which may itself use the inputs defined before it. The text stays
    /// as it is.
    ///
    /// ```
    /// use ppum_formula::{Formula, Scope};
    ///
    /// let scope = Scope::new(&["x", "y", "radius"])?;
    /// let radius = Formula::parse("sqrt(x^2 + y^2)", &scope)?;
    /// let f = Formula::parse("2*radius", &scope)?.substitute(&[("radius", &radius)])?;
    /// assert_eq!(f.evaluate(&[3.0, 4.0, f64::NAN]), 10.0);
    /// assert!(!f.uses("radius"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When the result is too large.
    ///
    /// # Panics
    /// When a definition has another scope.
    pub fn substitute(&self, definitions: &[(&str, &Self)]) -> Result<Self, DerivativeError> {
        let mut graph = Graph::new(self.scope.tables());
        let mut replaced = BTreeMap::new();
        for (name, definition) in definitions {
            assert_eq!(definition.scope, self.scope, "definitions have the formula's scope");
            let nodes = graph.absorb_with(definition.program.ops(), &replaced);
            let index = (0..).zip(self.scope.inputs()).find(|(_, known)| known == name);
            if let Some((index, _)) = index {
                replaced.insert(index, nodes[definition.root().index()]);
            }
            if graph.len() > MAX_NODES {
                return Err(DerivativeError::TooLarge);
            }
        }
        let root = graph.absorb_with(self.program.ops(), &replaced)[self.root().index()];
        let program = FormulaProgram::new(&graph, &[root]);
        Ok(Self { text: self.text.clone(), scope: Arc::clone(&self.scope), program })
    }
}

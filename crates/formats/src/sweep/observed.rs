//! A sweep with the fields at the probes of its base scene.

use super::axis::Column;
use super::fields::Fields;
use super::fingerprint::with_fields;
use super::kernels::{FieldKernels, Kernels, KernelsError};
use super::probed::probed;
use super::schema::FIELDS;
use super::spec::Spec;
use crate::error::SceneError;
use crate::section::parse;
use toml::Value;

/// Distinct Poisson's ratios of targets up to which each has its own response, and its own part of a table.
const FEW: usize = 256;

impl Spec {
    /// Whether its base scene has probes, whose fields need [`Self::with_fields`].
    #[must_use]
    pub fn has_probes(&self) -> bool {
        self.scene.contains_key("probe")
    }

    /// With the peaks of the fields at the probes of its base scene, which are then part of what makes two sweeps the same.
    ///
    /// Which results are written is chosen after it.
    ///
    /// # Errors
    /// [`KernelsError`].
    pub fn with_fields(mut self, asked: FieldKernels<'_>) -> Result<Self, KernelsError> {
        let kernels = Kernels::new(asked, self.has_many_ratios())?;
        self.fields = Fields::all(probed(&self.scene)?);
        let mut table = parse(&self.resolved)?;
        table.insert(FIELDS.into(), Value::Table(kernels.identity.clone()));
        self.resolved = table.to_string();
        self.fingerprint = with_fields(&self.fingerprint, &kernels.identity.to_string());
        self.kernels = Some(kernels);
        Ok(self)
    }

    /// Fails where kernels could not be read while rows were computed.
    pub(super) fn check_kernels(&self) -> Result<(), SceneError> {
        self.kernels.as_ref().map_or(Ok(()), Kernels::check)
    }

    /// Whether the targets have more Poisson's ratios than have responses of their own each.
    pub(super) fn has_many_ratios(&self) -> bool {
        let of_ratio = |column: &Column| {
            column.section == "target"
                && (column.key == "poisson_ratio" || column.key.ends_with("_speed_m_s"))
        };
        let mut axes = self.axes.iter();
        axes.any(|axis| axis.len > FEW && axis.columns.iter().any(of_ratio))
    }
}

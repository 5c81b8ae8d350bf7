"""Capabilities of the adapter, answered before anything else is imported."""

from rapidgen._json import Members

CAPABILITIES: Members = {
    "supportsConfigurationDoneRequest": True,
    "supportsFunctionBreakpoints": True,
    "supportsConditionalBreakpoints": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsBreakpointLocationsRequest": True,
    "supportsEvaluateForHovers": True,
    "supportsSetVariable": True,
    "supportsSetExpression": True,
    "supportsGotoTargetsRequest": True,
    "supportsCompletionsRequest": True,
    "completionTriggerCharacters": [".", ":"],
    "supportsRestartRequest": True,
    "supportsTerminateRequest": True,
    "supportTerminateDebuggee": True,
    "supportsExceptionInfoRequest": True,
    "supportsExceptionFilterOptions": True,
    "supportsLoadedSourcesRequest": True,
    "supportsDelayedStackTraceLoading": True,
    "supportsSteppingGranularity": False,
    "exceptionBreakpointFilters": [
        {
            "filter": "unhandled",
            "label": "Errors that stop a task",
            "default": True,
            "supportsCondition": True,
            "conditionDescription": "ERRNO names or event numbers: ERR_DIVZERO, 50024",
        },
        {
            "filter": "all",
            "label": "All errors, before each ERROR handler",
            "default": False,
            "supportsCondition": True,
            "conditionDescription": "ERRNO names: ERR_DIVZERO, ERR_SOCK_TIMEOUT",
        },
    ],
}

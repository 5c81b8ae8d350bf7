"""What the client does step by step: generators over effects, carried out by threads or a loop."""

!=== kernel_data
! rule: ERRNO and INTNO
! source: [K §12]
! given: system
MODULE Demo
    VAR num a;
    PROC main()
        a := ERRNO;
        a := INTNO;
    ENDPROC
ENDMODULE
!=== kernel_errors
! rule: the error numbers of the language
! source: [K §12]
MODULE Demo
    PROC main()
        IF ERRNO = ERR_ALRDYCNT TPErase;
        IF ERRNO = ERR_ARGDUPCND TPErase;
        IF ERRNO = ERR_ARGNOTPER TPErase;
        IF ERRNO = ERR_ARGNOTVAR TPErase;
        IF ERRNO = ERR_CALLPROC TPErase;
        IF ERRNO = ERR_CNTNOTVAR TPErase;
        IF ERRNO = ERR_DIVZERO TPErase;
        IF ERRNO = ERR_EXECPHR TPErase;
        IF ERRNO = ERR_FNCNORET TPErase;
        IF ERRNO = ERR_ILLDIM TPErase;
        IF ERRNO = ERR_ILLQUAT TPErase;
        IF ERRNO = ERR_ILLRAISE TPErase;
        IF ERRNO = ERR_INOMAX TPErase;
        IF ERRNO = ERR_MAXINTVAL TPErase;
        IF ERRNO = ERR_NEGARG TPErase;
        IF ERRNO = ERR_NOTARR TPErase;
        IF ERRNO = ERR_NOTEQDIM TPErase;
        IF ERRNO = ERR_NOTINTVAL TPErase;
        IF ERRNO = ERR_NOTPRES TPErase;
        IF ERRNO = ERR_OUTOFBND TPErase;
        IF ERRNO = ERR_REFUNKDAT TPErase;
        IF ERRNO = ERR_REFUNKFUN TPErase;
        IF ERRNO = ERR_REFUNKPRC TPErase;
        IF ERRNO = ERR_REFUNKTRP TPErase;
        IF ERRNO = ERR_STRTOOLNG TPErase;
        IF ERRNO = ERR_UNKINO TPErase;
    ENDPROC
ENDMODULE
!=== kernel_routines
! rule: the routines of the language itself
! source: [K §11]
MODULE Demo
    VAR intnum i;
    VAR num a;
    VAR bool b;
    VAR num v{3};
    PROC main()
        Break;
        IWatch i;
        ISleep i;
        a := Dim(v, 1);
        b := IsPers(a) OR IsVar(a);
        p \x:=1;
    ENDPROC
    PROC p(\num x)
        IF Present(x) TPErase;
    ENDPROC
ENDMODULE
